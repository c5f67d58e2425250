"""A Qwen2 of about 100,000 parameters with weights at random, and a byte-level BPE that is trained here: nothing is downloaded."""

import json

import numpy
from safetensors.numpy import save_file
from tokenizers import Tokenizer, decoders, models, pre_tokenizers, trainers

VOCABULARY = 512
HIDDEN, LAYERS, HEADS, KEY_HEADS, INNER = 64, 2, 4, 2, 128
LENGTH = 32768
END_OF_TEXT, BEGIN, END = "<|endoftext|>", "<|im_start|>", "<|im_end|>"
TEMPLATE = (
    "{% for message in messages %}{{ '<|im_start|>' + message['role'] + '\\n' + message['content'] + '<|im_end|>\\n' }}"
    "{% endfor %}{% if add_generation_prompt %}{{ '<|im_start|>assistant\\n' }}{% endif %}"
)


def train(texts):
    """A tokenizer of the kind that Qwen2 has, from texts."""
    tokenizer = Tokenizer(models.BPE())
    tokenizer.pre_tokenizer = pre_tokenizers.ByteLevel(add_prefix_space=False)
    tokenizer.decoder = decoders.ByteLevel()
    trainer = trainers.BpeTrainer(
        vocab_size=VOCABULARY,
        special_tokens=[END_OF_TEXT, BEGIN, END],
        initial_alphabet=pre_tokenizers.ByteLevel.alphabet(),
        show_progress=False,
    )
    tokenizer.train_from_iterator(texts, trainer)
    return tokenizer


def tensors(seed, words):
    """The weights. Wide enough that a step prefers some tokens by far, as a trained model does."""
    draw = numpy.random.default_rng(seed)
    normal = lambda *shape: (draw.standard_normal(shape) * 0.2).astype(numpy.float32)  # noqa: E731
    ones = numpy.ones(HIDDEN, numpy.float32)
    keys = KEY_HEADS * HIDDEN // HEADS
    made = {"model.embed_tokens.weight": normal(words, HIDDEN), "model.norm.weight": ones}
    for layer in range(LAYERS):
        at = f"model.layers.{layer}."
        for name, size in (("q", HIDDEN), ("k", keys), ("v", keys)):
            made[f"{at}self_attn.{name}_proj.weight"] = normal(size, HIDDEN)
            made[f"{at}self_attn.{name}_proj.bias"] = normal(size)
        made[f"{at}self_attn.o_proj.weight"] = normal(HIDDEN, HIDDEN)
        made[f"{at}mlp.gate_proj.weight"] = normal(INNER, HIDDEN)
        made[f"{at}mlp.up_proj.weight"] = normal(INNER, HIDDEN)
        made[f"{at}mlp.down_proj.weight"] = normal(HIDDEN, INNER)
        made[f"{at}input_layernorm.weight"] = ones
        made[f"{at}post_attention_layernorm.weight"] = ones
    return made


def write(folder, seed, tokenizer):
    """Writes a model as servers load it, and says how many parameters it has."""
    folder.mkdir(parents=True, exist_ok=True)
    token, words = tokenizer.token_to_id, tokenizer.get_vocab_size()
    config = {
        "architectures": ["Qwen2ForCausalLM"],
        "model_type": "qwen2",
        "vocab_size": words,
        "hidden_size": HIDDEN,
        "intermediate_size": INNER,
        "num_hidden_layers": LAYERS,
        "num_attention_heads": HEADS,
        "num_key_value_heads": KEY_HEADS,
        "max_position_embeddings": LENGTH,
        "sliding_window": LENGTH,
        "max_window_layers": LAYERS,
        "use_sliding_window": False,
        "hidden_act": "silu",
        "rms_norm_eps": 1e-6,
        "rope_theta": 10000.0,
        "tie_word_embeddings": True,
        "bos_token_id": token(END_OF_TEXT),
        "eos_token_id": token(END),
        "torch_dtype": "float32",
    }
    chat = {
        "tokenizer_class": "Qwen2Tokenizer",
        "chat_template": TEMPLATE,
        "eos_token": END,
        "pad_token": END_OF_TEXT,
        "bos_token": None,
        "unk_token": None,
        "model_max_length": LENGTH,
    }
    made = tensors(seed, words)
    (folder / "config.json").write_text(json.dumps(config))
    (folder / "generation_config.json").write_text(json.dumps({"eos_token_id": [token(END)]}))
    (folder / "tokenizer_config.json").write_text(json.dumps(chat))
    tokenizer.save(str(folder / "tokenizer.json"))
    save_file(made, str(folder / "model.safetensors"), metadata={"format": "pt"})
    return sum(tensor.size for tensor in made.values())
