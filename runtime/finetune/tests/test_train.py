"""Training: where the adapters are, what the loss counts, and going on after a checkpoint."""

import dataclasses
import json
import shutil

import pytest
import torch

from motet_finetune import adapters, merge, models, recipe, reply, rows, train
from motet_finetune.recipe import Lora

SMALL = dataclasses.replace(recipe.find("tiny"), batch=2, micro_batch=2, save_every=2, epochs=1.0, learning_rate=1e-2)
BOTH = Lora(decoder=16, vision=8, vision_layers=6)


@pytest.mark.parametrize("kind", ["qwen2", "mistral", "qwen2-vl", "qwen2.5-vl"])
def test_adapters_are_on_the_decoder_and_the_last_six_blocks(model, kind):
    from peft import get_peft_model

    base = models.load(str(model(kind)), "fp32")
    sees = kind.endswith("vl")
    made = get_peft_model(base, adapters.config(base, BOTH if sees else Lora(decoder=16)))
    ranks = {name: one.shape[0] for name, one in made.named_parameters() if name.endswith("lora_A.default.weight")}
    eye = {name: rank for name, rank in ranks.items() if ".visual." in name}
    blocks = {int(name.split("blocks.")[1].split(".")[0]) for name in eye}
    # Two layers of the decoder with seven linear layers each.
    assert sorted(set(ranks.values()) - {8}) == [16] and len(ranks) - len(eye) == 14
    assert (set(eye.values()), blocks) == (({8}, {2, 3, 4, 5, 6, 7}) if sees else (set(), set()))
    assert all("lora_" in name for name, one in made.named_parameters() if one.requires_grad)
    scales = {one.scaling["default"] for one in made.modules() if isinstance(getattr(one, "scaling", None), dict)}
    assert scales == {2.0}


def test_a_model_without_a_place_for_the_adapters_is_an_error(model):
    base = models.load(str(model("qwen2")), "fp32")
    with pytest.raises(adapters.AdapterError, match="`vision_layers` is 6, and the vision encoder has 0 blocks"):
        adapters.config(base, BOTH)
    with pytest.raises(adapters.AdapterError, match="has no decoder"):
        adapters.config(torch.nn.Sequential(torch.nn.Linear(2, 2)), Lora(decoder=16))


@pytest.mark.parametrize(("kind", "source"), [("qwen2", "data"), ("qwen2-vl", "pictures"), ("qwen2.5-vl", "pictures")])
def test_the_loss_counts_the_policy_alone(model, kind, source, request, tmp_path):
    folder = request.getfixturevalue(source)
    trainer, _ = train.prepared(SMALL, str(model(kind)), folder, tmp_path)
    policies = {row.policy for row in rows.read(folder / "train.jsonl")}
    tokenizer = models.tokenizer_of(trainer.processing_class)
    batch = next(iter(trainer.get_train_dataloader()))
    for ids, labels in zip(batch["input_ids"], batch["labels"], strict=True):
        counted = labels[labels != -100]
        assert tokenizer.decode(counted).removesuffix("<|im_end|>\n") in policies
        shown = tokenizer.decode(ids)
        assert shown.startswith("<|im_start|>system\nYou plan for a robot.") and "Bring me" in shown


def test_a_training_goes_on_after_its_last_checkpoint(model, data, tmp_path):
    whole = train.train(SMALL, str(model("qwen2")), data, tmp_path / "whole", most_steps=4)
    assert whole["updates"] == 4 and whole["loss_after"] < whole["loss_before"] and whole["resumed_from"] is None
    # As if it had been ended after the second update.
    cut = tmp_path / "cut"
    cut.mkdir()
    shutil.copy(tmp_path / "whole" / "recipe.json", cut)
    shutil.copytree(tmp_path / "whole" / "checkpoint-2", cut / "checkpoint-2")
    again = train.train(SMALL, str(model("qwen2")), data, cut, most_steps=4)
    assert again["resumed_from"] == "checkpoint-2" and again["updates"] == 4
    assert again["loss_after"] == pytest.approx(whole["loss_after"], abs=1e-5)
    with pytest.raises(train.TrainError, match="has a training with another recipe, model or data"):
        train.train(dataclasses.replace(SMALL, epochs=2.0), str(model("qwen2")), data, cut)
    with pytest.raises(train.TrainError, match="neither empty nor the folder of a training"):
        train.train(SMALL, str(model("qwen2")), data, data)


def test_long_rows_are_left_out_and_never_cut(model, data, tmp_path):
    known = rows.read(data / "train.jsonl")
    tokenizer = models.processor(str(model("qwen2")))
    assert train._fitting(known, tokenizer, 2048) == known
    with pytest.raises(train.TrainError, match="no row is left that has at most 5 tokens"):
        train.train(dataclasses.replace(SMALL, longest=5), str(model("qwen2")), data, tmp_path)


def test_pictures_need_a_model_that_sees(model, pictures, tmp_path):
    with pytest.raises(train.TrainError, match="the rows have pictures"):
        train.train(SMALL, str(model("qwen2")), pictures, tmp_path)


@pytest.mark.parametrize(("kind", "source"), [("qwen2", "data"), ("qwen2-vl", "pictures")])
def test_a_merged_model_replies_as_its_adapters(model, kind, source, request, tmp_path):
    folder = request.getfixturevalue(source)
    plan = (
        SMALL
        if kind == "qwen2"
        else dataclasses.replace(SMALL, lora=dataclasses.replace(SMALL.lora, vision=8, vision_layers=6))
    )
    report = train.train(plan, str(model(kind)), folder, tmp_path / "adapters", most_steps=3)
    assert report["trainable"] < report["parameters"]
    if kind != "qwen2":
        saved = json.loads((tmp_path / "adapters" / "adapter_config.json").read_text())
        assert len(saved["rank_pattern"]) == 6 * 4
    merge.merge(tmp_path / "adapters", tmp_path / "merged", precision="fp32")
    asked = rows.read(folder / "test.jsonl")
    apart = reply.opened(tmp_path / "adapters", most_tokens=24).replies(asked, [None] * len(asked))
    merged = reply.opened(tmp_path / "merged", most_tokens=24).replies(asked, [None] * len(asked))
    assert apart == merged
    base = reply.opened(model(kind), most_tokens=24).replies(asked, [None] * len(asked))
    assert base != merged
