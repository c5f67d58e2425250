"""Pictures in a notebook, which is executed as a person would."""

import xml.etree.ElementTree

import motet
import pytest

CELLS = [
    'import motet; of = dict(robot="hsr", scene="kitchen")',
    'motet.check("policy drop for hsr { place(mug_1, shelf) done }", scene="kitchen")',
    'graph = motet.compile(\'policy greet for hsr { say("<Hello> & more!") done }\'); graph',
    'motet.feasible("reach(mug_1)", **of)',
    'motet.simulate(motet.plan("bring me the red mug", **of).text, **of)',
    'motet.check("policy greet for hsr { done }")',
]


def is_svg(text):
    return xml.etree.ElementTree.fromstring(text).tag.endswith("svg")


def test_a_notebook_shows_reports_graphs_motions_and_runs():
    pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in CELLS])
    NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    shown = [cell.outputs[-1].data if cell.outputs else {} for cell in notebook.cells]
    assert "M0501" in shown[1]["text/html"] and "<table>" in shown[1]["text/html"]
    assert "&lt;Hello&gt;" in shown[2]["image/svg+xml"] and "no errors" in shown[2]["text/html"]
    assert "feasible" in shown[3]["text/html"]
    assert "pick" in shown[4]["image/svg+xml"] and " after " in shown[4]["text/html"]
    assert "no errors" in shown[5]["text/html"]
    for data in shown[1:]:
        assert is_svg(data["image/svg+xml"]) and "<" in data["text/html"]


def test_names_in_pictures_are_text():
    report = motet.check("policy p for hsr { go(x) <script>alert(1)</script> }", name="<script>")
    assert report and "<script>" not in report._repr_html_() and "<script>" not in report._repr_svg_()
    run = motet.simulate('policy p for hsr { say("<script>") done }')
    assert "&lt;script&gt;" in run._repr_html_() and "<script>" not in run._repr_html_() + run.graph._repr_html_()
