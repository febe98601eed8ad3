"""The report: the same numbers as the JSON in PDF and HTML, no one's words as markup, failures that say what failed."""

from __future__ import annotations

import gc
import io
import json
import re
import weakref
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import example as tried
from hypothesis import strategies as st
from pypdf import PdfReader

from heeltoe import InputError, read_case, rigid, with_spread
from heeltoe.case.field_usage import readers
from heeltoe.errors.sanitize import LONGEST, plain
from heeltoe.result.write import json_text
from heeltoe.views.content.drawings import caption
from heeltoe.views.content.input import fields, input_hash
from heeltoe.views.content.tree import Beside, Document, FigureBlock, Section, glued, paragraph
from heeltoe.views.figures.all import all_figures
from heeltoe.views.figures.write import save_all
from heeltoe.views.report.html import html
from heeltoe.views.report.typst_pdf import pages, pdf, source
from heeltoe.views.report.write import build_report, check_packages, draw_ahead, write_report
from heeltoe.views.words.numbers import Value
from heeltoe.warnings.notice import Notice
from shared.dams import BASE, BLOCK, FAST, SLENDER
from shared.report_reader import Reader, check_numbers, lookup, pdf_text, read_back, squeezed, values


@pytest.fixture(scope="module")
def block():
    case = read_case(
        BASE, ["motion.duration=5s", "motion.pga=1g", 'limits.residual_slip="10 mm"', "limits.peak_slip=9m"]
    )
    return case, with_spread(rigid(case), case, 3)


@pytest.fixture
def both(typical_both):
    return read_case(BASE, FAST), typical_both


@pytest.fixture(scope="module")
def document(typical_both):
    """The report of both."""
    return build_report(read_case(BASE, FAST), typical_both)


@pytest.mark.slow
def test_numbers_of_one_run_equal_those_of_the_json(block):
    reader, printed = check_numbers(build_report(*block), block[1])
    for key in ("residual_slip_m", "spread.residual_slip_m.mean", "energy.input_j", "motion.pga_g", "limits.0.value"):
        assert key in reader.numbers
    assert "NO" in printed
    assert "yes" in printed


def test_numbers_of_both_models_equal_those_of_the_json(both, document):
    reader, printed = check_numbers(document, both[1])
    for key in ("residual_slip_m", "beside.residual_slip_m", "ratio.residual_slip_m", "periods_s.0"):
        assert key in reader.numbers
    assert squeezed(both[1].meaning()) in printed


def test_numbers_have_units(document):
    plain = ("factor", "friction", "ratio.", "impacts", "events", "samples", "steps", "iterations", "elements", "nodes")
    # The caption says that factors have no unit.
    plain += ("modes", "residual", "statics.checks.", "open_contacts", "basis_error", "damping_ratio", "evidence.")
    for value in values(document.blocks):
        length_or_time = value.key.endswith(("_m", "_rad", "_s")) and "ratio." not in value.key
        if length_or_time or not any(word in value.key for word in plain):
            assert re.search(r"[a-zA-Z%]", value.text), value


@pytest.mark.usefixtures("no_figures")
def test_a_report_holds_all_that_it_shall(block):
    case, response = block
    reader = Reader(html(build_report(case, response, command="heeltoe run x.toml --report")))
    for reference in response.citation():
        assert reference in reader.text
    for words in (
        "Question and answer",
        "Input",
        "Ground motion",
        "Method",
        "Results",
        "How far to trust it",
        "Static checks",
        "Verdict against limits",
        "heeltoe run x.toml --report",
        input_hash(case, (response.motion, response.vertical)),
        case.title,
        "the dam slides",
    ):
        assert words in reader.text
    for text in map(str, response.warnings):
        assert squeezed(text) in squeezed(reader.text)
    # Every field of the case that has a value, whether given or not; of those that are not given, what is read.
    models = {"statics", *(run.model for run in response.responses)}
    for path, value, _, _ in fields(case, case.model_dump(mode="json"), given=True):
        assert value == "none" or path in reader.text
    appendix = reader.text.partition("Appendix: defaults")[2]
    for path, value, _, _ in fields(case, case.model_dump(mode="json"), given=False):
        assert value == "none" or (path in appendix) == bool(readers(path) & models)
    assert "script" not in reader.tags
    assert all(link.startswith(("data:image/svg+xml;base64,", "#s")) for link in reader.links)


def test_figures_of_a_report_are_there_and_not_empty(document):
    def figures(blocks):
        for item in blocks:
            if isinstance(item, Section):
                yield from figures(item.blocks)
            elif isinstance(item, Beside):
                yield from item.figures
            elif isinstance(item, FigureBlock):
                yield item

    result = {figure.name: figure for figure in figures(document.blocks)}
    assert {"section", "comparison", "crest", "crack", "spectrum"} <= set(result)
    assert result["crest"].caption.startswith("Flexible dam. ")
    for figure in result.values():
        assert len(figure.svg) > 5000
        assert figure.caption.endswith(".")
    assert caption("flexible/some-new_one") == "Flexible dam. Some new one."


def test_equations_are_numbered_in_order(document):
    def equations(blocks):
        for item in blocks:
            if isinstance(item, Section):
                yield from equations(item.blocks)
            elif hasattr(item, "typst"):
                yield item.number

    numbers = list(equations(document.blocks))
    assert len(numbers) > 8
    assert numbers == list(range(1, len(numbers) + 1))


def test_the_method_describes_what_the_dam_stands_on_and_before(typical_both):
    """Rock and water with sound where the case has them, else a plane and a mass along the face."""

    def method(*changes):
        page = html(build_report(read_case(BASE, changes), typical_both))
        return page.partition("Flexible dam</h3>")[2] or page

    around, plain_dam = method(), method("rock=rigid", "reservoir.compressible=false")
    for words in ("half-plane in plane strain", "Sound travels in the water"):
        assert words in around
        assert words not in plain_dam
    assert "standing with its crack on a rigid plane" in plain_dam
    assert "standing with its crack on rock" in around


def test_a_run_that_never_started_says_what_failed():
    case = read_case(BASE, ["crack.friction=0.2"])
    response = rigid(case)
    assert response.outcome == "unstable"
    document = build_report(case, response)
    first = PdfReader(io.BytesIO(pdf(document))).pages[0].extract_text()
    assert "No result to trust" in first
    assert squeezed(str(response.advice)) in squeezed(first)
    assert "NaN" not in html(document)
    assert "no results and no figures" in Reader(html(document)).text


@pytest.mark.usefixtures("no_figures")
def test_a_run_that_was_stopped_says_what_failed():
    case = read_case(BASE, ["analysis.event_limit=3"])
    response = rigid(case)
    assert response.outcome == "event limit"
    first = PdfReader(io.BytesIO(pdf(build_report(case, response)))).pages[0].extract_text()
    for words in ("No result to trust", "event limit", "they are no result", "stopped at"):
        assert words in first


@pytest.mark.usefixtures("no_figures")
def test_what_has_overturned_does_not_stand_after_the_earthquake():
    case = read_case(SLENDER)
    text = Reader(html(build_report(case, rigid(case)))).text
    assert "post-seismic: the earthquake overturns the block about its toe: nothing stands after it" in text
    assert "Static checks not met: equilibrium (post-seismic)" in text


@pytest.mark.usefixtures("no_figures")
def test_a_comparison_of_which_one_failed_says_so(both):
    case, comparison = both
    unstable = rigid(read_case(BASE, ["crack.friction=0.2"]))
    text = Reader(html(build_report(case, replace(comparison, beside=unstable)))).text
    assert "No result to trust" in text
    assert "what the flexible model found stands below" in text
    assert pdf(build_report(case, replace(comparison, beside=unstable)))


@pytest.mark.slow
def test_parts_that_are_missing_are_left_out(tmp_path):
    case = read_case(BLOCK, ['title=""'])
    paths = {path.name: path for path in write_report(case, rigid(case), str(tmp_path / "new" / "place"))}
    assert set(paths) == {"report.pdf", "report.html"}
    page = paths["report.html"].read_text()
    assert "Untitled case" in page
    assert "Untitled case" in pdf_text(paths["report.pdf"].read_bytes())
    assert "virtual mass" not in page.partition("Method")[2].partition("Results")[0]


TITLES = [
    "大坝在地震中",
    "Плотина",
    "سد خرساني",
    '#import "x"; $x$ *a* _b_ `c` <d> @e \\u{41}',
    "<script>alert(1)</script> & {{ x }}",
]


@pytest.mark.slow
@pytest.mark.parametrize("title", [*TITLES, "Long" * 60, "many words " * 40])
@pytest.mark.usefixtures("no_figures")
def test_titles_of_any_kind(block, title):
    case, response = block
    document = build_report(case.model_copy(update={"title": title}), replace(response, title=title))
    reader = Reader(html(document))
    shown = plain(title)
    assert len(shown) <= LONGEST
    assert shown in reader.text
    assert "script" not in reader.tags
    data = pdf(document)
    if title.isascii():
        assert squeezed(shown) in squeezed(pdf_text(data))
    assert PdfReader(io.BytesIO(data)).metadata.title == shown


def replaced(text):
    """A document that says the same everywhere."""
    return Document(text, text, text, (paragraph(text, Value("a", 1, text)), Section(text, (paragraph(text),))))


@pytest.mark.slow
@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(st.text(min_size=1, max_size=60))
@tried('"]#panic()[')
@tried("\\")
@tried("\u202e\x00\n")
def test_nobodys_words_are_markup(text):
    document = replaced(text)
    assert pdf(document)
    assert Reader(html(document)).tags == Reader(html(replaced("x"))).tags


@pytest.mark.usefixtures("no_figures")
def test_long_words_stay_on_the_page(block):
    # Ink to the right of the margin would mean that something runs over.
    case, response = block
    long = replace(
        response,
        motion=replace(response.motion, name="elcentro-" * 30),
        warnings=(Notice("motion-still", name="w" * 300),),
    )
    from PIL import Image

    for data in pages(build_report(case.model_copy(update={"title": "T" * 200}), long), 40.0):
        page = Image.open(io.BytesIO(data)).convert("L")
        margin = page.crop((round(page.width * 192 / 210), 0, page.width, page.height))
        assert margin.getextrema()[0] > 200


@pytest.mark.slow
def test_the_same_input_makes_the_same_report(block):
    one, other = build_report(*block), build_report(*block)
    assert html(one) == html(other)
    assert pdf(one) == pdf(other)


def test_the_hash_tells_inputs_apart(block):
    case, response = block
    own = input_hash(case, (response.motion, None))
    assert own == input_hash(read_case(json.loads(case.model_dump_json())), (response.motion, None))
    assert own != input_hash(case, (response.motion.scaled(1.0 + 1e-12), None))
    other = read_case(BASE, ["crack.restitution=0.51"])
    assert own != input_hash(other, (response.motion, None))


#: A number with a unit of SI that people of the United States do not use.


SI = r"\d\s?(mm|cm|m|km|m/s|m/s²|m/s\^2|k?N/m|MN/m|[kMG]?Pa|k?J/m|MJ/m|kg/m\^3|kg/m³|t/m)(?![\w/²³^])"


@pytest.mark.usefixtures("no_figures")
@pytest.mark.parametrize("which", ["block", "both", "never"])
def test_units_of_the_united_states_all_through(which, request):
    if which == "never":
        case = read_case(BASE, ["crack.friction=0.2"])
        subject = (case, rigid(case))
    else:
        subject = request.getfixturevalue(which)
        subject = (subject[0].model_copy(update={"title": "Dam of 100 m"}), subject[1])
    document = build_report(*subject, units="us")
    reader = Reader(html(document))
    for unit in (" in", "kip/ft", "ft", "psi", "per foot of dam"):
        assert unit in reader.text
    for text in (reader.text, pdf_text(pdf(document))):
        # A title, and how a scenario is written.
        text = re.sub(r"Dam of\s100\sm|M6\.\s?5,\s?20\s?km", "", text)
        match = re.search(f".{{30}}{SI}", text)
        assert not match, match
    data = {**json.loads(json_text(subject[1].to_json()))}
    for key, (number, text) in reader.numbers.items():
        if not key.startswith("statics."):
            assert number == lookup(data, key), key
        if not text.startswith("under"):
            shown_number, half = read_back(text)
            assert abs(shown_number) == pytest.approx(abs(number), abs=half * 1.0001, rel=1e-3), (key, text)


def test_figures_drawn_ahead_make_the_same_report_and_are_let_go(block, tmp_path):
    case, response = block
    figures = all_figures(case, response)
    later, first = tmp_path / "later", tmp_path / "first"
    later.mkdir()
    first.mkdir()
    save_all(figures, later)
    expected = build_report(case, response, figures=figures)
    ahead, drawn = draw_ahead(case, response, "si"), []

    def finish(name, figure):
        gc.collect()
        assert not any(other() for other in drawn)
        drawn.append(weakref.ref(figure))
        ahead.finish(name, figure)

    save_all(ahead.figures, first, finish)
    assert len(drawn) == len(figures)
    assert build_report(case, response, figures=ahead.figures, ahead=ahead) == expected
    for path in later.iterdir():
        assert (first / path.name).read_bytes() == path.read_bytes()


def test_a_number_stays_with_its_unit_on_paper():
    document = Document("x", "y", "z", (paragraph(glued("damped by 5 % at 20 GPa")),))
    assert "by 5\u00a0% at 20\u00a0GPa" in source(document)


def test_packages_that_do_not_work_are_named(monkeypatch):
    def fail(name):
        raise ImportError("cannot allocate memory")

    monkeypatch.setattr("heeltoe.views.report.write.import_module", fail)
    with pytest.raises(InputError, match=r"typst, which does not work here \(cannot allocate memory\)") as result:
        check_packages()
    assert result.value.code == "report-package-broken"


def test_packages_that_are_missing_are_named(monkeypatch, tmp_path, block):
    monkeypatch.setattr("heeltoe.views.report.write.find_spec", lambda name: None)
    with pytest.raises(InputError) as result:
        check_packages()
    assert result.value.code == "package-missing"
    assert "pip install jinja2 typst" in str(result.value)
    with pytest.raises(InputError) as result:
        write_report(*block, tmp_path, kinds=("docx",))
    assert result.value.code == "not-a-choice"
    assert list(tmp_path.iterdir()) == []


def test_letters_without_a_font_are_owned_up_to(monkeypatch):
    document = Document("x", "y", "z", (paragraph("\U00012345"),))
    monkeypatch.setattr("heeltoe.views.figures.fonts._other_fonts", lambda: ())
    assert "no font was found" in source(document)
    assert "no font was found" not in source(Document("Плотина μ²", "y", "z", ()))
    assert pdf(document)


@pytest.mark.slow
def test_nothing_is_left_half_written(tmp_path, block):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError) as result:
        write_report(*block, tmp_path / "file" / "below", kinds=("html",))
    assert result.value.code == "cannot-write"
