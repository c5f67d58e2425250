"""GGUF files, read back by `gguf` and by the reader of transformers, which was written apart from our writer."""

import json
import shutil

import pytest
import torch
from transformers import AutoModelForCausalLM

from motet_finetune import export, models


@pytest.mark.parametrize("kind", ["qwen2", "mistral"])
def test_a_gguf_is_the_model(model, kind, tmp_path):
    path = tmp_path / "model.gguf"
    # A name with `mistral` in it leads the reader of transformers astray.
    folder = shutil.copytree(model(kind), tmp_path / "tiny")
    export.export(folder, path)
    found = export.compare(folder, path)
    assert found["largest_difference"] == 0.0 and found["tensors"] > 20
    ids = torch.arange(3, 40)[None]
    with torch.inference_mode():
        ours = models.load(str(model(kind)), "fp32")(ids).logits
        theirs = AutoModelForCausalLM.from_pretrained(tmp_path, gguf_file="model.gguf", dtype=torch.float32)(ids).logits
    assert torch.allclose(ours, theirs, atol=1e-4)


@pytest.mark.parametrize(("precision", "most"), [("fp16", 1e-3), ("bf16", 2e-3)])
def test_smaller_numbers_are_close(model, precision, most, tmp_path):
    export.export(model("qwen2"), tmp_path / "model.gguf", precision)
    assert 0 < export.compare(model("qwen2"), tmp_path / "model.gguf")["largest_difference"] < most


def test_the_vocabulary_is_the_tokenizer_s(model, tmp_path):
    import gguf

    export.export(model("qwen2"), tmp_path / "model.gguf")
    reader = gguf.GGUFReader(str(tmp_path / "model.gguf"))
    tokens = reader.get_field("tokenizer.ggml.tokens").contents()
    tokenizer = models.processor(str(model("qwen2")))
    assert [tokens[at] for at in range(len(tokenizer))] == tokenizer.convert_ids_to_tokens(range(len(tokenizer)))
    assert reader.get_field("tokenizer.ggml.eos_token_id").contents() == tokenizer.eos_token_id
    assert "im_start" in reader.get_field("tokenizer.chat_template").contents()


def test_models_that_are_not_written_say_what_does(model, tmp_path):
    with pytest.raises(export.ExportError, match="models of type `qwen2_vl` are not written here.*convert_hf_to_gguf"):
        export.export(model("qwen2-vl"), tmp_path / "model.gguf")
    config = json.loads((model("qwen2") / "config.json").read_text())
    (tmp_path / "config.json").write_text(json.dumps({**config, "rope_parameters": {"rope_type": "yarn"}}))
    with pytest.raises(export.ExportError, match="scaled rotary positions"):
        export.export(tmp_path, tmp_path / "model.gguf")
    with pytest.raises(export.ExportError, match="config.json"):
        export.export(tmp_path / "nowhere", tmp_path / "model.gguf")
