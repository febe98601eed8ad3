"""Numbers that a header states in words: how many values there are, how far apart, how long and how strong."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.quantities import units_in
from heeltoe.motion.records.words import COUNT, DISPLACEMENT, DURATION, PEAK, RATE, STEP, VELOCITY, folded

_NUMBER = r"[-+]?(?:\d+(?:[.,]\d+)*\.?|[.,]\d+)(?:[ed][-+]?\d+)?(?![\d:/])"
_BRACKET = r"(?:\s*[\[(]\s*([^\])]{0,20}?)\s*[\])])?"
_LINK = r"\s*(?:of|is|are|von|ist|betragt|de|est|es|di|e|da|olan|=>|->)?\s*[:=]*\s*"
_UNIT = r"\s*([\[(]?\s*[%a-z\u0370-\u04ff\u3000-\u9fff][\w/^*²%-]*(?:\s*(?:/|per)\s*[\w^]+)*)?"


def _statement(word: str) -> re.Pattern[str]:
    """A pattern of a statement of a word: the unit in brackets behind it, its number, the unit behind that."""
    return pattern(rf"({word}){_BRACKET}{_LINK}({_NUMBER}){_UNIT}")


_STEPS, _RATES, _COUNTS, _DURATIONS, _PEAKS = map(_statement, (STEP, RATE, COUNT, DURATION, PEAK))
# A bare word of a sentence that these are too, unless a colon or an equals sign parts it from its number.
_LOOSE = pattern(
    r"step|interval\w*|pas|paso|passo|βημα|шаг|anzahl|werte|punkte|count|sampling|points|samples|data"
    r"|delta|every|alle|takt|chaque|(?:a )?cada|ogni|her|ανα|через|毎|每"
)
# "3000 points at 0.01 sec", "equally spaced at .02 sec", "200 samples/s".
_NUMBER_OF = pattern(
    rf"({_NUMBER})\s*(?:data\s*)?(?:points|pts|samples|values|werte|punkte|valeurs|datos|puntos|valori|punti|pontos|veri"
    r"|σημεια|τιμες|точек|значений|点|個)(?!\s*/)(?![\w])"
)
_SPACED = pattern(
    rf"(?:spaced|interval\w*|step\w*|points|samples|values|data)\s+(?:at|of)(?:\s+intervals?\s+of)?\s+({_NUMBER})\s*"
    r"(s|secs?|seconds?|ms|msecs?)(?![\w/])"
)
_SAMPLES_A_SECOND = pattern(
    rf"({_NUMBER})\s*(?:samples?|points|muestras|campioni|amostras|werte|ornek)\s*(?:/|per\s+|por\s+|pro\s+)\s*s"
)
# Words beside a length or a peak of a part of the motion, or of another one.
_OTHER_TIMES = pattern(r"signif|5\s*-\s*95|5-75|d5|bracket|strong|pre-?event|husid|rise|rupture|fault|source")
_RAW = pattern(r"\braw\b|uncor|before|original|unscaled|vertical|brut|roh|crudo|target|hedef|ziel|cible|objetivo")
# Two statements of one step: 0.008 s and 128 Hz.
_NEAR = 0.05
# Words right before another that make it one of another thing.
_OF_ANOTHER = pattern(r"(?:-|\b(?:original|raw|old|former|uncorrected|before)\s*)$")
_SECONDS = {
    r"s|secs?|seconds?|sn|saniye|seg|segundos?|sek(?:unden?)?|secondi|secondes?|с|сек|δευτ?|δ|秒|сек": 1.0,
    r"ms|msecs?|milliseconds?|millisekunden?|мс|ミリ秒|毫秒|msn": 1e-3,
    r"us|microseconds?": 1e-6,
    r"mins?|minutes?|минут\w*|dk|分": 60.0,
    r"h|hrs?|hours?": 3600.0,
}
_HERTZ = {r"hz|1/s|s-1|s\^-1|sps|samples?/s\w*|/s|sample/s|muestras/s|гц|ヘルツ|赫兹|ornek/s": 1.0, r"khz": 1e3}


#: Stands for the unit of a count that no label has, as in "the first 1500 points of it".
IN_A_SENTENCE = "in a sentence"


@dataclass(frozen=True)
class Written:
    """A number as written: its value, its rounding, and the unit beside it."""

    value: float
    rounding: float
    unit: str = ""

    def agrees(self, other: float, share: float = 0.0, more: float = 0.0) -> bool:
        """Whether another number equals this one within its rounding, a share of it, and `more`."""
        return abs(self.value - other) <= self.rounding + share * abs(self.value) + more


@dataclass(frozen=True)
class Stated:
    """Numbers that a header states; empty where it does not.

    Attributes
    ----------
    counts
        How many values or rows there are.
    steps
        How far apart they are [s].
    durations
        How long the record is [s].
    peaks
        How strong it is, in the unit that is beside it, or in none.
    """

    counts: tuple[Written, ...] = ()
    steps: tuple[Written, ...] = ()
    durations: tuple[Written, ...] = ()
    peaks: tuple[Written, ...] = ()

    def is_count(self, count: int) -> bool:
        """Whether a count is among those stated."""
        return any(stated.value == count for stated in self.counts)

    def step(self, name: str) -> float | None:
        """Return the one step [s] that is stated; None where none is.

        Raises
        ------
        InputError
            Where several are stated that differ.
        """
        if not self.steps:
            return None
        first = self.steps[0].value
        for other in self.steps[1:]:
            if abs(first - other.value) > _NEAR * max(first, other.value):
                raise InputError("record-steps-stated", name, f"{first:g} s", other=f"{other.value:g} s")
        # A number with more digits is nearer to what was meant.
        return min(self.steps, key=lambda written: written.rounding).value


def read_stated(header: list[str]) -> Stated:
    """Return what the lines of a header state, in the words of :mod:`heeltoe.motion.records.words`."""
    counts, steps, durations, peaks = list[Written](), list[Written](), list[Written](), list[Written]()
    for line in map(folded, header):
        counts += _counts_in(line)
        steps += _steps_in(line)
        durations += _durations_in(line)
        peaks += _peaks_in(line)
    # A length without a unit may count the values.
    whole = {count.value for count in counts}
    return Stated(tuple(counts), tuple(steps), tuple(d for d in durations if d.value not in whole), tuple(peaks))


def seconds_in(unit: str) -> float | None:
    """Return how many seconds a unit of time has; None where it is not known."""
    bare = folded(unit).strip(". [](){}")
    return next((size for names, size in _SECONDS.items() if re.fullmatch(names, bare)), None)


def number(text: str) -> Written | None:
    """Return the number that a text is, with a decimal point or a decimal comma; None where it can be none."""
    text = text.lower().replace("d", "e")
    mantissa, _, exponent = text.rstrip(".").partition("e")
    points, commas = mantissa.count("."), mantissa.count(",")
    if points and commas:
        # The last one is decimal, the others part thousands.
        decimal = "." if mantissa.rindex(".") > mantissa.rindex(",") else ","
        mantissa = mantissa.replace("," if decimal == "." else ".", "").replace(",", ".")
    elif points > 1 or commas > 1:
        # A sign that parts thousands has three digits behind it.
        if not re.fullmatch(r"[-+]?\d{1,3}(?:[.,]\d{3})+", mantissa):
            return None
        mantissa = mantissa.replace(".", "").replace(",", "")
    else:
        mantissa = mantissa.replace(",", ".")
    try:
        power = 10.0 ** int(exponent or 0)
        value = float(mantissa) * power
    except (ValueError, OverflowError):
        return None
    return Written(value, power * 10.0 ** -len(mantissa.partition(".")[2]))


def _matches(pattern: re.Pattern[str], line: str) -> Iterator[re.Match[str]]:
    """Walk what a line states; what is a word of a sentence only is left out."""
    for match in pattern.finditer(line[:400]):
        between = line[match.end(1) : match.start(3)]
        parted = any(sign in between for sign in ":=[(")
        if parted or not _LOOSE.fullmatch(match[1]):
            # Such as two-step, or that of the record before it was resampled.
            if _OF_ANOTHER.search(line[: match.start()]):
                continue
            yield match


def _counts_in(line: str) -> list[Written]:
    texts = [(match[3], "") for match in _matches(_COUNTS, line)]
    texts += [(match[1], IN_A_SENTENCE) for match in _NUMBER_OF.finditer(line[:400])]
    found = []
    for text, how in texts:
        # 4,000 and 4.000 are thousands here.
        digits = re.sub(r"(?<=\d)[.,](?=\d{3}(?!\d))", "", text)
        value = number(digits)
        if value is not None and value.value >= 2.0 and value.value == int(value.value):
            found.append(Written(value.value, 0.0, how))
    return found


def _steps_in(line: str) -> list[Written]:
    found = []
    for match in _matches(_STEPS, line):
        found += _step(match[3], match[2] or "", match[4] or "", rate=False)
    for match in _matches(_RATES, line):
        found += _step(match[3], match[2] or "", match[4] or "", rate=True)
    for match in _SPACED.finditer(line[:400]):
        found += _step(match[1], "", match[2], rate=False)
    for match in _SAMPLES_A_SECOND.finditer(line[:400]):
        found += _step(match[1], "", "hz", rate=True)
    unique = list[Written]()
    for step in found:
        if all(step != other for other in unique):
            unique.append(step)
    return unique


def _step(text: str, bracket: str, behind: str, *, rate: bool) -> list[Written]:
    """The step [s] that a number states by its unit, else by its word."""
    written = number(text)
    if written is None or written.value <= 0.0:
        return []
    for unit in (behind, bracket):
        bare = unit.strip(". [](){}")
        if (hertz := next((size for names, size in _HERTZ.items() if re.fullmatch(names, bare)), None)) is not None:
            return [_of_rate(written, hertz)]
        if (size := seconds_in(bare)) is not None:
            # Thousandths are divided, so that 20 ms are 0.02 s to the last bit.
            value = written.value / (1.0 / size) if size < 1.0 else written.value * size
            return [Written(value, written.rounding * size)]
    if bracket.strip() or (behind.strip() and re.fullmatch(r"[^\W\d_]+", behind.strip()) and not rate):
        # Fortnights, or a unit that is not known.
        return []
    # No record has a value in 200 s: that many are a rate, and less than one a second are a step.
    if rate and written.value >= 1.0:
        return [_of_rate(written, 1.0)]
    return [written] if not rate or written.value < 1.0 else []


def _of_rate(written: Written, hertz: float) -> Written:
    rate = written.value * hertz
    return Written(1.0 / rate, 0.0)


def _durations_in(line: str) -> list[Written]:
    if _OTHER_TIMES.search(line):
        return []
    found = []
    for match in _matches(_DURATIONS, line):
        written = number(match[3])
        unit = (match[4] or match[2] or "s").strip()
        size = seconds_in(unit)
        if written is not None and size is not None and written.value > 0.0:
            found.append(Written(written.value * size, written.rounding * size))
    return found


def _peaks_in(line: str) -> list[Written]:
    found = []
    for match in _matches(_PEAKS, line):
        around = line[max(0, match.start() - 30) : match.end() + 20]
        if _RAW.search(around) or re.search(VELOCITY, around) or re.search(DISPLACEMENT, around):
            continue
        written = number(match[3])
        text = match[4] or match[2] or ""
        units = units_in(f"[{text.strip(' [()]')}]")
        if written is None or (text.strip(" [()]") and not units and _is_a_unit(text)):
            continue
        found.append(Written(abs(written.value), written.rounding, units.pop() if len(units) == 1 else ""))
    return found


def _is_a_unit(text: str) -> bool:
    """Whether what stands behind a number is its unit rather than the next word of a sentence."""
    bare = text.strip(" [()]")
    return bool(re.search(r"[/%^]", bare)) or len(bare) <= 4
