"""Recipes: the papers' numbers, and mistakes."""

import subprocess
import sys

import pytest

from motet_finetune import recipe

FINE = 'model = "m"\nlearning_rate = 1e-4\nepochs = 2\nbatch = 4\n{}\n[lora]\ndecoder = 16\n{}\n'


def check(tmp_path, top="", lora=""):
    path = tmp_path / "recipe.toml"
    path.write_text(FINE.format(top, lora))
    return recipe.read(path)


@pytest.mark.parametrize(
    ("name", "model", "vision"),
    [
        ("vlp-decoder", "Qwen/Qwen2.5-VL-3B-Instruct", (0, 0)),
        ("vlp-vision-decoder", "Qwen/Qwen2.5-VL-3B-Instruct", (8, 6)),
        ("inteliplan-mistral", "mistralai/Mistral-7B-Instruct-v0.3", (0, 0)),
    ],
)
def test_recipes_have_the_numbers_of_the_papers(name, model, vision):
    one = recipe.find(name)
    assert (one.model, one.learning_rate, one.epochs, one.precision) == (model, 1e-4, 2.0, "bf16")
    assert (one.lora.decoder, one.lora.vision, one.lora.vision_layers) == (16, *vision)


def test_every_builtin_recipe_is_read():
    assert len(recipe.builtin()) >= 5
    for path in recipe.builtin().values():
        recipe.read(path)


@pytest.mark.parametrize(
    ("top", "lora", "why"),
    [
        ("ranks = 3", "", "unknown key `ranks`"),
        ("", "rank = 3", "lora: unknown key `rank`"),
        ("micro_batch = 3", "", "`micro_batch` must be a divisor of `batch`"),
        ("precision = 'int8'", "", "`precision` must be one of bf16, fp32"),
        ("warmup = nan", "", "`warmup` must be a share below 1"),
        ("seed = true", "", "seed: expected int, not True"),
        ("longest = '8k'", "", "longest: expected int, not '8k'"),
        ("", "vision = 8", "`lora.vision_layers` must be above 0 with `vision`"),
        ("", "whole = ['norm', 3]", "whole: expected a list of texts"),
        ("=", "", "Invalid statement"),
    ],
)
def test_a_mistake_is_an_error_with_its_place(tmp_path, top, lora, why):
    with pytest.raises(recipe.RecipeError, match="recipe.toml: ") as error:
        check(tmp_path, top, lora)
    assert why in str(error.value)


def test_a_recipe_without_a_rank_or_a_file_is_an_error(tmp_path):
    path = tmp_path / "recipe.toml"
    path.write_text('model = "m"\nlearning_rate = 1e-4\nepochs = 2\nbatch = 4\n[lora]\n')
    with pytest.raises(recipe.RecipeError, match="lora: `decoder` is missing"):
        recipe.read(path)
    with pytest.raises(recipe.RecipeError, match="there is no recipe `vlp`; built in: inteliplan-mistral, "):
        recipe.find("vlp")


def test_the_command_lists_recipes_and_reports_mistakes(tmp_path):
    def command(*flags):
        return subprocess.run(
            [sys.executable, "-m", "motet_finetune", *flags], capture_output=True, text=True, check=False
        )

    listed = command("recipes")
    assert listed.returncode == 0
    assert (
        "vlp-vision-decoder: Qwen/Qwen2.5-VL-3B-Instruct, rank 16 on the decoder, 8 on the last 6 vision"
        in listed.stdout
    )
    wrong = command("train", "vlp", str(tmp_path), "--out", str(tmp_path / "out"))
    assert (wrong.returncode, wrong.stderr.splitlines()[-1][:42]) == (1, "motet-finetune: there is no recipe `vlp`; ")
