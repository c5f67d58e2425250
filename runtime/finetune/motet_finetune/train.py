"""Training: adapters on a model, with the loss on the policies alone."""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from pathlib import Path
from typing import Any

from . import adapters, models, rows
from .recipe import Recipe

__all__ = ["TrainError", "prepared", "train"]

RECIPE = "recipe.json"


class TrainError(ValueError):
    """A training that cannot begin or go on."""


def train(
    recipe: Recipe,
    model: str,
    data: Path,
    out: Path,
    *,
    evaluate_every: int = 0,
    most_steps: int = 0,
    without: frozenset[str] = frozenset(),
) -> dict[str, Any]:
    """Trains adapters of a recipe on `train.jsonl` of a folder, and gives the losses on `test.jsonl` before and after.

    Rows with a request of `without`, which are the requests of an evaluation, are left out of the training.

    The folder `out` gets checkpoints and, at the end, the adapters. If it has checkpoints of the same training, the training
    goes on after the last one.
    """
    from transformers.trainer_utils import get_last_checkpoint

    before = _resumed(recipe, model, data, out, without)
    trainer, left_out = prepared(
        recipe, model, data, out, evaluate_every=evaluate_every, most_steps=most_steps, without=without
    )
    last = get_last_checkpoint(str(out)) if before else None
    first = None if last else trainer.evaluate()["eval_loss"]
    trainer.train(resume_from_checkpoint=last)
    final = trainer.evaluate()["eval_loss"]
    if not math.isfinite(final):
        raise TrainError("the loss is no number any more: lower the learning rate")
    trainer.save_model(str(out))
    trainer.processing_class.save_pretrained(out)
    sizes = [(one.numel(), one.requires_grad) for one in trainer.model.parameters()]
    report = {
        "model": model,
        "rows": len(trainer.train_dataset),
        "rows_left_out": left_out,
        "held_out": len(trainer.eval_dataset),
        "parameters": sum(size for size, _ in sizes),
        "trainable": sum(size for size, is_trained in sizes if is_trained),
        "updates": trainer.state.global_step,
        "resumed_from": last and Path(last).name,
        "loss_before": first,
        "loss_after": final,
        "losses": [
            {key: line[key] for key in ("step", "loss", "eval_loss") if key in line}
            for line in trainer.state.log_history
            if "loss" in line or "eval_loss" in line
        ],
    }
    (out / "report.json").write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    return report


def prepared(
    recipe: Recipe,
    model: str,
    data: Path,
    out: Path,
    *,
    evaluate_every: int = 0,
    most_steps: int = 0,
    without: frozenset[str] = frozenset(),
) -> tuple[Any, int]:
    """TRL's trainer for a recipe, and the number of training rows that were left out."""
    from trl import SFTTrainer

    made = models.processor(model, recipe.most_pixels)
    known = rows.read(data / "train.jsonl")
    trained = _fitting(rows.without(known, without), made, recipe.longest)
    held_out = _fitting(rows.read(data / "test.jsonl"), made, recipe.longest)
    if not trained or not held_out:
        raise TrainError(f"{data}: no row is left that has at most {recipe.longest} tokens")
    loaded = models.load(model, recipe.precision)
    if trained[0].images and not models.has_vision(loaded.config):
        raise TrainError(f"{data}: the rows have pictures, and `{model}` does not see")
    trainer = SFTTrainer(
        model=loaded,
        args=_arguments(recipe, out, evaluate_every, most_steps),
        train_dataset=rows.table(trained, made),
        eval_dataset=rows.table(held_out, made),
        processing_class=made,
        peft_config=adapters.config(loaded, recipe.lora),
    )
    return trainer, len(known) - len(trained)


def _resumed(recipe: Recipe, model: str, data: Path, out: Path, without: frozenset[str]) -> bool:
    """True if the folder has a training that began; an error if that was another one. Otherwise notes this one there."""
    noted = {"recipe": asdict(recipe), "model": model, "data": str(data.resolve()), "without": sorted(without)}
    noted = json.loads(json.dumps(noted))
    path = out / RECIPE
    if path.is_file():
        if json.loads(path.read_text(encoding="utf-8")) != noted:
            raise TrainError(f"{out} has a training with another recipe, model or data: give another folder")
        return True
    if out.is_dir() and any(out.iterdir()):
        raise TrainError(f"{out} is neither empty nor the folder of a training")
    out.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(noted, indent=1) + "\n", encoding="utf-8")
    return False


def _fitting(known: list[rows.Row], made: Any, longest: int) -> list[rows.Row]:
    """The rows whose text has at most so many tokens."""
    tokenizer = models.tokenizer_of(made)

    def length(row: rows.Row) -> int:
        prompt = row.prompt
        if not isinstance(prompt, str):
            prompt = tokenizer.apply_chat_template(
                rows.conversation(tokenizer, prompt), tokenize=False, add_generation_prompt=True
            )
        return len(tokenizer(prompt + row.policy)["input_ids"]) + 2

    return [row for row in known if length(row) <= longest]


def _arguments(recipe: Recipe, out: Path, evaluate_every: int, most_steps: int) -> Any:
    import torch
    from trl import SFTConfig

    cuda = torch.cuda.is_available()
    if recipe.precision == "bf16" and cuda and not torch.cuda.is_bf16_supported():
        raise TrainError("this GPU has no BF16")
    return SFTConfig(
        output_dir=str(out),
        learning_rate=recipe.learning_rate,
        lr_scheduler_type="cosine",
        warmup_steps=recipe.warmup,
        weight_decay=recipe.weight_decay,
        num_train_epochs=recipe.epochs,
        max_steps=most_steps or -1,
        per_device_train_batch_size=recipe.micro_batch,
        per_device_eval_batch_size=recipe.micro_batch,
        gradient_accumulation_steps=recipe.batch // recipe.micro_batch,
        gradient_checkpointing=recipe.recompute,
        bf16=recipe.precision == "bf16",
        use_cpu=not cuda,
        # The loss counts the policy and the end of the turn, as the papers have it.
        completion_only_loss=True,
        # Rows that are too long were left out; none is cut.
        max_length=None,
        eval_strategy="steps" if evaluate_every else "no",
        eval_steps=evaluate_every or None,
        logging_steps=10,
        save_strategy="steps",
        save_steps=recipe.save_every,
        save_total_limit=recipe.keep,
        seed=recipe.seed,
        data_seed=recipe.seed,
        report_to="none",
        dataloader_num_workers=0,
    )
