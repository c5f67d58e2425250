"""The tiny Qwen2 as GGUF, which llama.cpp reads: the same weights under its names, the same tokens in the same order."""

import json

import gguf
import numpy

from weights import (
    BEGIN,
    END,
    END_OF_TEXT,
    HEADS,
    HIDDEN,
    INNER,
    KEY_HEADS,
    LAYERS,
    LENGTH,
    TEMPLATE,
    tensors,
)

NAMES = {
    "self_attn.q_proj": "attn_q",
    "self_attn.k_proj": "attn_k",
    "self_attn.v_proj": "attn_v",
    "self_attn.o_proj": "attn_output",
    "mlp.gate_proj": "ffn_gate",
    "mlp.up_proj": "ffn_up",
    "mlp.down_proj": "ffn_down",
    "input_layernorm": "attn_norm",
    "post_attention_layernorm": "ffn_norm",
}


def renamed(name):
    """The name of a tensor in llama.cpp. The output's weights are those of the input, so they are not stored."""
    if name == "model.embed_tokens.weight":
        return "token_embd.weight"
    if name == "model.norm.weight":
        return "output_norm.weight"
    _, _, layer, *rest = name.split(".")
    *part, kind = rest
    return f"blk.{layer}.{NAMES['.'.join(part)]}.{kind}"


def write(path, seed, tokenizer):
    """Writes a model, and says how many parameters it has."""
    model = json.loads(tokenizer.to_str())["model"]
    words = tokenizer.get_vocab_size()
    tokens = [tokenizer.id_to_token(number) for number in range(words)]
    special = {END_OF_TEXT, BEGIN, END}
    control, normal = gguf.TokenType.CONTROL, gguf.TokenType.NORMAL
    writer = gguf.GGUFWriter(str(path), "qwen2")
    writer.add_name("tiny")
    writer.add_context_length(LENGTH)
    writer.add_embedding_length(HIDDEN)
    writer.add_block_count(LAYERS)
    writer.add_feed_forward_length(INNER)
    writer.add_head_count(HEADS)
    writer.add_head_count_kv(KEY_HEADS)
    writer.add_layer_norm_rms_eps(1e-6)
    writer.add_rope_freq_base(10000.0)
    writer.add_vocab_size(words)
    writer.add_tokenizer_model("gpt2")
    writer.add_tokenizer_pre("qwen2")
    writer.add_token_list(tokens)
    writer.add_token_types([control if token in special else normal for token in tokens])
    writer.add_token_merges([" ".join(pair) if isinstance(pair, list) else pair for pair in model["merges"]])
    writer.add_eos_token_id(tokenizer.token_to_id(END))
    writer.add_pad_token_id(tokenizer.token_to_id(END_OF_TEXT))
    writer.add_add_bos_token(False)
    writer.add_chat_template(TEMPLATE)
    made = tensors(seed, words)
    for name, tensor in made.items():
        writer.add_tensor(renamed(name), numpy.ascontiguousarray(tensor))
    writer.write_header_to_file()
    writer.write_kv_data_to_file()
    writer.write_tensors_to_file()
    writer.close()
    return sum(tensor.size for tensor in made.values())
