"""Tables with headers in ten languages: never a wrong count, step or unit without an error or a warning.

Each file is written from a series that is known, so that it is its own right value. Its words are those that people of
that language write, of which the reader need not know every one.
"""

from __future__ import annotations

import random
from dataclasses import dataclass

import numpy as np
import pytest

from heeltoe import InputError
from heeltoe.motion.records.read import read_text_channels
from heeltoe.motion.records.to_motion import Options

G = 9.80665
#: Size of each unit [m/s2].
UNITS = {
    "g": G,
    "G": G,
    "%g": G / 100.0,
    "m/s2": 1.0,
    "m/s²": 1.0,
    "m/s/s": 1.0,
    "m/s^2": 1.0,
    "cm/s2": 0.01,
    "cm/sec2": 0.01,
    "cm/s²": 0.01,
    "gal": 0.01,
    "Gal": 0.01,
    "mm/s^2": 0.001,
    "ft/s2": 0.3048,
}


@dataclass(frozen=True)
class Language:
    """Words of headers: how a station, a count, a step, a rate, a length, a peak, a unit and columns are called."""

    station: str
    counts: tuple[str, ...]
    steps: tuple[str, ...]
    rates: tuple[str, ...]
    durations: tuple[str, ...]
    peaks: tuple[str, ...]
    units: tuple[str, ...]
    time: str
    acceleration: str
    prose: tuple[str, ...]


LANGUAGES = {
    "English": Language(
        "Station",
        ("Number of points", "NPTS", "Number of Data", "No. of samples", "Points in record", "Total samples"),
        ("Time step", "DT", "Time Increment (s)", "Sampling interval (sec)", "delta"),
        ("Sampling rate", "Sample rate (Hz)", "Sampling frequency"),
        ("Duration", "Record length (s)", "Lasts"),
        ("PGA", "Peak acceleration", "Max. acc.", "Largest value"),
        ("Units", "Unit", "Given in"),
        "Time",
        "Acceleration",
        ("Acceleration time series of the main shock", "recorded at a free field site near the river on soft soil"),
    ),
    "German": Language(
        "Station",
        ("Anzahl der Werte", "Anzahl Datenpunkte", "Messwerte gesamt"),
        ("Zeitschritt", "Abtastintervall (s)", "Schrittweite", "Takt"),
        ("Abtastrate", "Abtastfrequenz (Hz)"),
        ("Dauer", "Aufzeichnungsdauer (s)"),
        ("Spitzenwert", "Maximalwert", "Größter Wert"),
        ("Einheit", "Angaben in"),
        "Zeit",
        "Beschleunigung",
        ("Beschleunigung über der Zeit an der Sohle", "gemessen bei dem Erdbeben vom ersten Januar im Tal"),
    ),
    "French": Language(
        "Station",
        ("Nombre de points", "Nombre d'échantillons", "Total des valeurs"),
        ("Pas de temps", "Intervalle d'échantillonnage (s)", "Pas"),
        ("Fréquence d'échantillonnage", "Taux d'échantillonnage (Hz)"),
        ("Durée", "Durée totale (s)"),
        ("Accélération maximale", "Valeur maximale", "Plus grande valeur"),
        ("Unité", "Exprimé en"),
        "Temps",
        "Accélération",
        ("Accélération du sol pendant le séisme principal", "enregistrée sur le rocher à côté du barrage en vallée"),
    ),
    "Spanish": Language(
        "Estación",
        ("Número de datos", "Número de puntos", "Cantidad de valores"),
        ("Intervalo de muestreo (s)", "Paso de tiempo", "Cada"),
        ("Frecuencia de muestreo", "Velocidad de muestreo (Hz)"),
        ("Duración", "Duración total (s)"),
        ("Aceleración máxima", "Valor máximo", "Mayor valor"),
        ("Unidades", "Expresado en"),
        "Tiempo",
        "Aceleración",
        ("Aceleración del terreno durante el sismo principal", "registrada en roca junto a la presa del valle vacío"),
    ),
    "Italian": Language(
        "Stazione",
        ("Numero di punti", "Numero di campioni", "Totale valori"),
        ("Passo di campionamento", "Intervallo di tempo (s)", "Ogni"),
        ("Frequenza di campionamento", "Frequenza di campionamento (Hz)"),
        ("Durata", "Durata totale (s)"),
        ("Accelerazione massima", "Valore massimo", "Valore più grande"),
        ("Unità", "Espresso in"),
        "Tempo",
        "Accelerazione",
        ("Accelerazione del suolo durante il terremoto", "registrata su roccia accanto alla diga nella valle vuota"),
    ),
    "Portuguese": Language(
        "Estação",
        ("Número de pontos", "Número de amostras", "Total de valores"),
        ("Intervalo de amostragem (s)", "Passo de tempo", "A cada"),
        ("Frequência de amostragem", "Taxa de amostragem (Hz)"),
        ("Duração", "Duração total (s)"),
        ("Aceleração máxima", "Valor máximo", "Maior valor"),
        ("Unidades", "Expresso em"),
        "Tempo",
        "Aceleração",
        ("Aceleração do terreno durante o sismo principal", "registada em rocha junto da barragem no vale vazio"),
    ),
    "Turkish": Language(
        "İstasyon",
        ("Veri sayısı", "Nokta sayısı", "Toplam değer"),
        ("Örnekleme aralığı (sn)", "Zaman adımı", "Her"),
        ("Örnekleme frekansı", "Örnekleme hızı (Hz)"),
        ("Süre", "Kayıt süresi (sn)"),
        ("En büyük ivme", "Maksimum ivme", "En yüksek değer"),
        ("Birim", "Ölçü"),
        "Zaman",
        "İvme",
        ("Ana şok sırasında zeminin ivme kaydı burada", "vadideki barajın yanında kaya üzerinde alınan kayıt budur"),
    ),
    "Greek": Language(
        "Σταθμός",
        ("Αριθμός σημείων", "Πλήθος τιμών", "Σύνολο"),
        ("Χρονικό βήμα", "Διάστημα δειγματοληψίας (s)", "Ανά"),
        ("Συχνότητα δειγματοληψίας", "Ρυθμός δειγματοληψίας (Hz)"),
        ("Διάρκεια", "Συνολική διάρκεια (s)"),
        ("Μέγιστη επιτάχυνση", "Μέγιστη τιμή", "Η πιο μεγάλη τιμή"),
        ("Μονάδα", "Σε"),
        "Χρόνος",
        "Επιτάχυνση",
        ("Επιτάχυνση του εδάφους στον κύριο σεισμό", "καταγραφή σε βράχο δίπλα στο φράγμα της άδειας κοιλάδας"),
    ),
    "Russian": Language(
        "Станция",
        ("Число точек", "Количество отсчётов", "Всего"),
        ("Шаг по времени", "Интервал дискретизации (с)", "Через"),
        ("Частота дискретизации", "Частота опроса (Гц)"),
        ("Длительность", "Продолжительность (с)"),
        ("Максимальное ускорение", "Пиковое значение", "Самое большое значение"),
        ("Единица", "В чём"),
        "Время",
        "Ускорение",
        ("Ускорение грунта при главном толчке", "запись на скале рядом с плотиной в пустой долине"),
    ),
    "Japanese": Language(
        "観測点",
        ("データ数", "サンプル数", "総数"),
        ("サンプリング間隔(秒)", "時間刻み", "毎"),
        ("サンプリング周波数", "サンプリングレート(Hz)"),
        ("継続時間", "記録時間(秒)"),
        ("最大加速度", "最大値", "一番大きい値"),
        ("単位", "表示"),
        "時間",
        "加速度",
        ("本震 の 地表 加速度 の 記録", "谷 の ダム の 横 の 岩盤 の 上 の 記録"),
    ),
}


@dataclass(frozen=True)
class File:
    """A file and what is in it: its text, its accelerations [m/s2], its step [s], the size of their last digit, and
    whether its header tells the truth."""

    text: str
    series: list[np.ndarray]
    step: float
    digit: float
    honest: bool


def _number(value: float, comma: bool, form: str = ".6g") -> str:
    text = format(value, form)
    return text.replace(".", ",") if comma else text


def _header(rng: random.Random, words: Language, values: np.ndarray, step: float, unit: str, commas: bool) -> list[str]:
    """Lines in any order, of which any may be missing."""
    sign = rng.choice([": ", " = ", ":", " : ", "= "])
    count = len(values)
    lines = []
    if rng.random() < 0.75:
        lines.append(f"{rng.choice(words.counts)}{sign}{count}")
    if rng.random() < 0.85:
        if rng.random() < 0.6:
            word = rng.choice(words.steps)
            bare = "(" in word
            milli = not bare and rng.random() < 0.2
            text = _number(1e3 * step if milli else step, commas, ".9g")
            lines.append(f"{word}{sign}{text}{'' if bare else ' ms' if milli else rng.choice([' s', ' sec', ''])}")
        else:
            word = rng.choice(words.rates)
            lines.append(f"{word}{sign}{_number(1.0 / step, commas)}{'' if '(' in word else rng.choice([' Hz', ''])}")
    if rng.random() < 0.3:
        word = rng.choice(words.durations)
        lines.append(f"{word}{sign}{_number(step * (count - 1), commas, '.3f')}{'' if '(' in word else ' s'}")
    if rng.random() < 0.3:
        peak = float(np.abs(values).max())
        lines.append(f"{rng.choice(words.peaks)}{sign}{_number(peak, commas, '.4f')}{rng.choice(['', ' ' + unit])}")
    if rng.random() < 0.5:
        lines.append(f"{words.station}{sign}{rng.choice(['ABC', 'Made Up, Nowhere', 'X 12', 'Vega 2'])}")
    if rng.random() < 0.8:
        bracket = rng.choice(["({})", "[{}]", "({} )"])
        unit_line = rng.choice(
            [f"{rng.choice(words.units)}{sign}{unit}", f"{words.acceleration} {bracket.format(unit)}", unit.join("()")]
        )
        lines.append(unit_line)
    rng.shuffle(lines)
    return lines


def _prose(rng: random.Random, words: Language, width: int) -> list[str]:
    """Sentences, one of them often of as many words as a row has numbers."""
    sentences = []
    for _ in range(rng.randrange(3)):
        text = rng.choice(words.prose).split()
        length = width if rng.random() < 0.6 else rng.randint(1, len(text))
        sentences.append(" ".join(text[:length]))
    return sentences


def _made(rng: random.Random, words: Language) -> File:
    count, step = rng.randint(60, 300), rng.choice([0.005, 0.01, 0.02, 0.004, 0.0025, 1.0 / 128.0])
    unit = rng.choice(list(UNITS))
    layout = rng.choice(["one", "rows", "rows", "pairs", "named"])
    commas = rng.random() < 0.35
    noise = np.random.default_rng(rng.randrange(2**32))
    size = 1.5 / UNITS[unit]
    values = [
        share * size * np.hanning(count) * np.sin(np.cumsum(noise.uniform(0.05, 0.9, count)))
        for share in (1.0, 0.6, 0.3)
    ]
    digits = max(0, 5 - int(np.floor(np.log10(size))))
    values = [np.round(series, digits) for series in values[: 3 if layout == "named" else 1]]
    width = {"one": 1, "rows": rng.randint(2, 10), "pairs": 2, "named": 4}[layout]
    header = _header(rng, words, values[0], step, unit, commas)
    honest = True
    if rng.random() < 0.1:
        # A count of another record, or its step, which the length gives away.
        if rng.random() < 0.5:
            header.append(f"{words.counts[0]}: {count // 2}")
        else:
            header += [f"{words.steps[0]}: {2.0 * step:g}", f"{words.durations[0]}: {step * (count - 1):.3f} s"]
        honest = False
    prose = _prose(rng, words, width)
    lines = [*prose[:1], *header, *prose[1:]] if rng.random() < 0.7 else [*prose, *header]
    between = rng.choice([";", "\t", "  "]) if commas else rng.choice([" ", "  ", "\t", ",", ";", ", "])
    form = f".{digits}f"
    if layout in ("one", "rows"):
        cells = [_number(value, commas, form) for value in values[0]]
        rows = [between.join(cells[k : k + width]) for k in range(0, count, width)]
    else:
        places = rng.choice([2, 3, 4, 6])
        times = [_number(step * k, commas, f".{places}f") for k in range(count)]
        table = [[_number(value, commas, form) for value in series] for series in values]
        rows = [between.join(cells) for cells in zip(times, *table, strict=True)]
        names = [words.acceleration] if layout == "pairs" else ["NS", "EW", "UD"]
        if layout == "named" or rng.random() < 0.6:
            named = [f"{words.time} [s]", *(f"{name} [{unit}]" for name in names)]
            lines.append(between.join(named) if between.strip() else rng.choice([" ", "  "]).join(named))
    mark = rng.choice(["", "# ", "% "])
    text = "".join(f"{mark}{line}\n" for line in lines) + "\n".join(rows) + "\n"
    return File(text, [UNITS[unit] * series for series in values], step, UNITS[unit] * 0.51 * 10.0**-digits, honest)


def _is_right(file: File, motions: list) -> bool:
    """Whether what was read is what was written."""
    if len(motions) != len(file.series):
        return False
    for motion, series in zip(motions, file.series, strict=True):
        if motion.acceleration.shape != series.shape or np.abs(motion.acceleration - series).max() > file.digit:
            return False
        # A time that is printed with few digits may be off by half of the last one.
        if abs(motion.duration - file.step * (series.size - 1)) > 0.0051 or abs(motion.dt / file.step - 1.0) > 0.01:
            return False
    return True


def _tried(count: int, seed: str) -> tuple[int, int, int]:
    """How many files were read rightly without a word, with one, or refused; a wrong one without a word fails."""
    rng = random.Random(f"headers {seed}")
    silent = warned = refused = 0
    for number in range(count):
        name = rng.choice(list(LANGUAGES))
        file = _made(rng, LANGUAGES[name])
        try:
            motions = read_text_channels(file.text.encode(), "a.txt", Options(assume=True))
        except InputError:
            refused += 1
            continue
        said = any(motion.warnings for motion in motions)
        assert said or _is_right(file, motions), f"{name}, file {number}:\n{file.text[:700]}"
        assert said or file.honest, f"{name}, file {number}:\n{file.text[:700]}"
        warned, silent = warned + said, silent + (not said)
    return silent, warned, refused


@pytest.mark.parametrize("seed", ["a", "b"])
def test_no_header_makes_a_file_be_read_wrongly_in_silence(seed):
    silent, _, refused = _tried(200, seed)
    # As much is read as is stated: a reader that refuses all would pass as well.
    assert silent > 60
    assert refused < 140


@pytest.mark.slow
def test_no_header_of_five_thousand_makes_a_file_be_read_wrongly_in_silence():
    """Each reading takes some milliseconds, all of them half a minute: what a few hundred miss shows here."""
    silent, _, refused = _tried(5_000, "many")
    assert silent > 1_500
    assert refused < 3_500
