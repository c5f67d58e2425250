"""Extras of the package, and what the wheel has for each of them."""

import importlib.metadata
import importlib.util

import pytest


def test_each_extra_asks_for_what_its_modules_import():
    package = importlib.metadata.metadata("motet")
    assert set(package.get_all("Provides-Extra")) == {"mujoco", "transformers", "view"}
    needs = importlib.metadata.requires("motet") or []
    physics = ["mujoco", "numpy", "opencv-python-headless"]
    for extra, libraries in {"mujoco": physics, "transformers": ["numpy", "transformers"], "view": []}.items():
        asked = sorted(need.split(">")[0] for need in needs if f"extra == '{extra}'" in need.replace('"', "'"))
        assert asked == libraries, (extra, needs)
    assert all("extra ==" in need for need in needs), "the package itself needs Python alone"


@pytest.mark.parametrize("module", ["motet_mujoco", "motet.transformers", "motet.vllm", "motet.sglang"])
def test_the_wheel_has_the_modules_of_its_extras(module):
    assert importlib.util.find_spec(module) is not None


def test_view_writes_a_page(command, tmp_path):
    import motet

    motet.simulate('policy greet for hsr { say("Hello!") done }', record=tmp_path / "run")
    command("view", tmp_path / "run", "-o", tmp_path / "page.html")
    assert "<html" in (tmp_path / "page.html").read_text()
