"""GGUF of a merged model, which llama.cpp, Ollama and mistral.rs read: written with the package `gguf`.

Text decoders of Qwen2 and Llama (Mistral too) with a byte-level BPE. For other models, for models that see, and for smaller
numbers than 16 bits, use `convert_hf_to_gguf.py` and `llama-quantize` of llama.cpp on the merged folder.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

__all__ = ["ExportError", "compare", "export"]

# How llama.cpp names the architecture, and how it splits texts before it merges bytes.
KINDS = {"qwen2": ("qwen2", "qwen2"), "llama": ("llama", "llama-bpe"), "mistral": ("llama", "llama-bpe")}
SUFFIXES = (".weight", ".bias")


class ExportError(ValueError):
    """A model that cannot be written as GGUF here."""


def export(folder: Path, path: Path, precision: str = "fp32") -> None:
    """Writes the model of a folder. Weights of two dimensions get the precision (fp32, fp16, bf16); others stay in fp32."""
    import gguf

    config = _read(folder / "config.json")
    kind = _kind(config)
    types = {
        "fp32": gguf.GGMLQuantizationType.F32,
        "fp16": gguf.GGMLQuantizationType.F16,
        "bf16": gguf.GGMLQuantizationType.BF16,
    }
    writer = gguf.GGUFWriter(str(path), KINDS[kind][0])
    writer.add_name(folder.name)
    writer.add_context_length(config["max_position_embeddings"])
    writer.add_embedding_length(config["hidden_size"])
    writer.add_block_count(config["num_hidden_layers"])
    writer.add_feed_forward_length(config["intermediate_size"])
    writer.add_head_count(config["num_attention_heads"])
    writer.add_head_count_kv(config.get("num_key_value_heads") or config["num_attention_heads"])
    writer.add_layer_norm_rms_eps(config["rms_norm_eps"])
    writer.add_rope_freq_base(_rope(config))
    head = config.get("head_dim") or config["hidden_size"] // config["num_attention_heads"]
    writer.add_rope_dimension_count(head)
    if kind != "qwen2":
        writer.add_key_length(head)
        writer.add_value_length(head)
    writer.add_vocab_size(config["vocab_size"])
    writer.add_file_type(
        {
            "fp32": gguf.LlamaFileType.ALL_F32,
            "fp16": gguf.LlamaFileType.MOSTLY_F16,
            "bf16": gguf.LlamaFileType.MOSTLY_BF16,
        }[precision]
    )
    _vocabulary(writer, folder, kind, config["vocab_size"])
    for name, tensor in _tensors(folder, config, kind):
        wanted = types[precision] if tensor.ndim > 1 else types["fp32"]
        data = gguf.quants.quantize(tensor, wanted)
        writer.add_tensor(name, data, raw_dtype=wanted)
    writer.write_header_to_file()
    writer.write_kv_data_to_file()
    writer.write_tensors_to_file()
    writer.close()


def compare(folder: Path, path: Path) -> dict[str, Any]:
    """Reads a GGUF file back and compares it with the model of a folder: tensors, largest difference, tokens."""
    import gguf
    import numpy

    config = _read(folder / "config.json")
    kind = _kind(config)
    reader = gguf.GGUFReader(str(path))
    stored = {one.name: one for one in reader.tensors}
    worst = 0.0
    count = 0
    for name, tensor in _tensors(folder, config, kind):
        one = stored.pop(name, None)
        if one is None:
            raise ExportError(f"{path}: the tensor {name} is missing")
        back = gguf.quants.dequantize(one.data, one.tensor_type).reshape(tensor.shape)
        worst = max(worst, float(numpy.abs(back - tensor).max()))
        count += 1
    if stored:
        raise ExportError(f"{path}: the tensor {next(iter(stored))} is not the model's")
    field = reader.get_field("tokenizer.ggml.tokens")
    tokens = 0 if field is None else len(field.data)
    if tokens != config["vocab_size"]:
        raise ExportError(f"{path}: {tokens} tokens, and the model has {config['vocab_size']}")
    return {"tensors": count, "largest_difference": worst, "tokens": tokens}


def _read(path: Path) -> dict[str, Any]:
    try:
        value: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as why:
        raise ExportError(f"{path}: {why}") from why
    return value


def _kind(config: dict[str, Any]) -> str:
    kind = str(config.get("model_type"))
    if kind not in KINDS:
        raise ExportError(
            f"models of type `{kind}` are not written here, only {', '.join(KINDS)}: use llama.cpp's convert_hf_to_gguf.py"
        )
    scaling = config.get("rope_scaling") or config.get("rope_parameters") or {}
    if scaling.get("rope_type", scaling.get("type", "default")) != "default":
        raise ExportError("scaled rotary positions are not written here: use llama.cpp's convert_hf_to_gguf.py")
    return kind


def _rope(config: dict[str, Any]) -> float:
    return float((config.get("rope_parameters") or {}).get("rope_theta") or config.get("rope_theta") or 10000.0)


def _vocabulary(writer: Any, folder: Path, kind: str, width: int) -> None:
    import gguf

    tokenizer = _read(folder / "tokenizer.json")
    model = tokenizer["model"]
    if model.get("type") != "BPE" or model.get("byte_fallback") or not model.get("merges"):
        raise ExportError("only a byte-level BPE is written here: use llama.cpp's convert_hf_to_gguf.py")
    types = [gguf.TokenType.UNUSED] * width
    tokens = [f"[PAD{number}]" for number in range(width)]
    for token, number in model["vocab"].items():
        tokens[number], types[number] = token, gguf.TokenType.NORMAL
    for token in tokenizer.get("added_tokens", []):
        tokens[token["id"]] = token["content"]
        types[token["id"]] = gguf.TokenType.CONTROL if token["special"] else gguf.TokenType.USER_DEFINED
    merges = [pair if isinstance(pair, str) else " ".join(pair) for pair in model["merges"]]
    writer.add_tokenizer_model("gpt2")
    writer.add_tokenizer_pre(KINDS[kind][1])
    writer.add_token_list(tokens)
    writer.add_token_types(types)
    writer.add_token_merges(merges)
    known = {token["content"]: token["id"] for token in tokenizer.get("added_tokens", [])}
    chat = _read(folder / "tokenizer_config.json")
    for key, add in (
        ("eos_token", writer.add_eos_token_id),
        ("pad_token", writer.add_pad_token_id),
        ("bos_token", writer.add_bos_token_id),
    ):
        name = chat.get(key)
        name = name.get("content") if isinstance(name, dict) else name
        if name in known:
            add(known[name])
    writer.add_add_bos_token(bool(chat.get("add_bos_token", False)))
    template = folder / "chat_template.jinja"
    text = template.read_text(encoding="utf-8") if template.is_file() else chat.get("chat_template")
    if isinstance(text, str):
        writer.add_chat_template(text)


def _tensors(folder: Path, config: dict[str, Any], kind: str) -> Iterator[tuple[str, Any]]:
    """The tensors under llama.cpp's names, in fp32, in the order of their files."""
    import gguf
    import numpy
    import torch
    from safetensors import safe_open

    names = gguf.get_tensor_name_map(
        gguf.MODEL_ARCH.QWEN2 if kind == "qwen2" else gguf.MODEL_ARCH.LLAMA, config["num_hidden_layers"]
    )
    heads = config["num_attention_heads"]
    keys = config.get("num_key_value_heads") or heads
    files = sorted(folder.glob("*.safetensors"))
    if not files:
        raise ExportError(f"{folder} has no safetensors")
    for file in files:
        with safe_open(str(file), framework="pt") as opened:
            for name in opened.keys():  # noqa: SIM118 - no mapping
                if name == "lm_head.weight" and config.get("tie_word_embeddings"):
                    continue
                renamed = names.get_name(name, try_suffixes=SUFFIXES)
                if renamed is None:
                    raise ExportError(f"{file.name}: llama.cpp has no name for the tensor {name}")
                tensor = opened.get_tensor(name).to(torch.float32).numpy()
                if kind != "qwen2" and ".self_attn.q_proj." in name:
                    tensor = _interleaved(tensor, heads)
                elif kind != "qwen2" and ".self_attn.k_proj." in name:
                    tensor = _interleaved(tensor, keys)
                yield renamed, numpy.ascontiguousarray(tensor)


def _interleaved(tensor: Any, heads: int) -> Any:
    """Rows of a projection in the order of llama.cpp's Llama, which turns neighbours where the hub's turns halves."""
    shape = tensor.shape
    return tensor.reshape(heads, 2, shape[0] // heads // 2, *shape[1:]).swapaxes(1, 2).reshape(shape)
