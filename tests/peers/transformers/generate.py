"""Policies by a model of transformers with random weights: from any weights, what is written checks."""

import json
import sys
import tempfile
from pathlib import Path

import torch
from tokenizers import Tokenizer
from transformers import GPT2Config, GPT2LMHeadModel, PreTrainedTokenizerFast

import motet
from motet.transformers import MotetLogitsProcessor

sys.path.insert(0, str(Path(__file__).parents[3] / "python/tests"))
from small_tokenizer import END, tokenizer_json  # noqa: E402

TOKENS = 400
WAYS = {
    "greedy": {"do_sample": False},
    "sampled": {"do_sample": True, "temperature": 1.5, "num_return_sequences": 4},
    "beams": {"do_sample": False, "num_beams": 3},
}


def model_of(seed, size, end):
    """More logits than the tokenizer has tokens, as models have."""
    torch.manual_seed(seed)
    ends = {"bos_token_id": end, "eos_token_id": end, "pad_token_id": end}
    config = GPT2Config(vocab_size=size + 7, n_positions=TOKENS + 16, n_embd=32, n_layer=2, n_head=2, **ends)
    return GPT2LMHeadModel(config).eval()


def main():
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "tokenizer.json"
        path.write_text(json.dumps(tokenizer_json()))
        tokenizer = PreTrainedTokenizerFast(tokenizer_object=Tokenizer.from_file(str(path)), eos_token=END)
    environment = motet.Environment(robot="hsr", scene="kitchen")
    decoder = motet.Decoder(environment=environment, tokenizer=tokenizer, budget=TOKENS - 1)
    prompt = tokenizer("Bring me the red mug.", return_tensors="pt")
    wrong = count = 0
    for seed in range(4):
        model = model_of(seed, len(tokenizer), decoder.vocabulary.end)
        for way, options in WAYS.items():
            processor = MotetLogitsProcessor(decoder)
            with torch.no_grad():
                rows = model.generate(**prompt, max_new_tokens=TOKENS, logits_processor=[processor], **options)
            for row in rows:
                text = tokenizer.decode(row[prompt["input_ids"].shape[1] :], skip_special_tokens=True)
                said = [said for said in environment.check(text) if said["severity"] == "error"]
                count, wrong = count + 1, wrong + bool(said)
                if said:
                    print(f"{way}, seed {seed}: {text}: {said[0]['code']} {said[0]['message']}")
    print(f"{count - wrong} of {count} policies check without an error")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
