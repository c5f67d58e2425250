"""The open-vocabulary detector with a tiny model: its weights are random, its files and its code are the real ones.

Needs `pip install 'motet-mujoco[open-vocabulary]'`, with transformers 5.
"""

import io
import json
import string
import sys
import types

import numpy as np
import pytest
from motet_mujoco import open_vocabulary
from motet_mujoco.camera import Picture

WORDS = ["red mug", "apple"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder as `save_pretrained` writes it: a model of one layer, and a processor that reads letters."""
    torch = pytest.importorskip("torch")
    transformers = pytest.importorskip("transformers", minversion="5")
    path = tmp_path_factory.mktemp("owlv2")
    letters = [letter + end for end in ("", "</w>") for letter in string.ascii_lowercase]
    # The text ends at its greatest token.
    vocabulary = {token: at for at, token in enumerate(["!", *letters, "<|startoftext|>", "<|endoftext|>"])}
    tokenizer = transformers.CLIPTokenizer(vocab=vocabulary, merges=[], pad_token="!", model_max_length=16)
    pictures = transformers.Owlv2ImageProcessor(size={"height": 64, "width": 64})
    transformers.Owlv2Processor(pictures, tokenizer).save_pretrained(path)
    small = {"hidden_size": 32, "intermediate_size": 64, "num_hidden_layers": 1, "num_attention_heads": 2}
    ends = {"bos_token_id": len(vocabulary) - 2, "eos_token_id": len(vocabulary) - 1, "pad_token_id": 0}
    torch.manual_seed(0)
    config = transformers.Owlv2Config(text_config={**small, "vocab_size": len(vocabulary), **ends}, projection_dim=32,
                                      vision_config={**small, "image_size": 64, "patch_size": 16})
    transformers.Owlv2ForObjectDetection(config).save_pretrained(path)
    return path


@pytest.fixture
def picture():
    """A red square in the middle, 1 m ahead, before a grey wall at 2 m."""
    colour, depth = np.full((48, 64, 3), 128, dtype=np.uint8), np.full((48, 64), 2.0)
    colour[16:32, 24:40], depth[16:32, 24:40] = (200, 38, 38), 1.0
    return Picture("camera", colour, depth, np.zeros(3), np.eye(3), 60.0)


def test_a_folder_is_loaded_and_finds_boxes_in_a_picture(folder, picture, monkeypatch):
    detector = open_vocabulary.OpenVocabulary.load(str(folder), WORDS, threshold=0.0)
    assert not detector.model.training
    shapes, forward = [], detector.model.forward

    def seen(**inputs):
        outputs = forward(**inputs)
        shapes.append([tuple(inputs["pixel_values"].shape), tuple(inputs["input_ids"].shape),
                       tuple(outputs.logits.shape), tuple(outputs.pred_boxes.shape)])
        return outputs

    monkeypatch.setattr(detector.model, "forward", seen)
    found = detector.detect(picture)
    # 64 pixels in patches of 16 make 16 boxes; each has a score for each word.
    assert shapes == [[(1, 3, 64, 64), (2, 16), (1, 16, 2), (1, 16, 4)]]
    assert 0 < len(found) <= 16 and {one["label"] for one in found} <= set(WORDS)
    assert [one["confidence"] for one in found] == sorted((one["confidence"] for one in found), reverse=True)
    for one in found:
        assert one["id"] is None and len(one["extent"]) == 3 and 0.0 <= one["confidence"] <= 1.0
        assert abs(one["pose"]["xyz"][2] - 1.0) < 0.01 or abs(one["pose"]["xyz"][2] - 2.0) < 0.01
    surest = found[0]["confidence"]
    assert open_vocabulary.OpenVocabulary.load(str(folder), WORDS, threshold=surest + 0.001).detect(picture) == []


def test_the_program_answers_lines(folder, picture, monkeypatch, capsys):
    lines = (json.dumps(dict(picture.message(), solids=[])) + "\n") * 2
    monkeypatch.setattr(sys, "stdin", io.StringIO(lines))
    open_vocabulary.main(["--model", str(folder), "--words", WORDS[0], "--words", WORDS[1], "--threshold", "0"])
    answers = [json.loads(line)["detections"] for line in capsys.readouterr().out.splitlines()]
    assert len(answers) == 2 and answers[0] == answers[1] != []
    assert set(answers[0][0]) == {"label", "id", "pose", "extent", "confidence"}


def test_a_box_has_the_place_of_what_fills_its_middle(picture):
    position, extent = open_vocabulary.place(picture, (20, 12, 44, 36))
    assert np.allclose(position, [0.0, 0.0, 1.0], atol=0.01) and abs(extent[0] - 15.0 / 60.0) < 0.02
    assert open_vocabulary.place(picture, (0, 0, 1, 1)) is None


def test_the_model_and_its_processor_are_those_of_a_folder(monkeypatch, tmp_path):
    """The program loads the model and its processor of a folder, and answers lines with what they find."""
    asked = []

    class Part:
        def __init__(self, name):
            self.name, self.is_frozen = name, False

        @classmethod
        def from_pretrained(cls, folder):
            asked.append((cls.__name__, folder))
            return cls(folder)

        def eval(self):
            self.is_frozen = True
            return self

    kinds = {name: type(name, (Part,), {}) for name in ("Owlv2ForObjectDetection", "Owlv2Processor")}
    monkeypatch.setitem(sys.modules, "transformers", types.SimpleNamespace(**kinds))
    loaded = open_vocabulary.OpenVocabulary.load(str(tmp_path), ["red mug"], 0.3)
    assert sorted(asked) == [(name, str(tmp_path)) for name in sorted(kinds)]
    assert loaded.model.is_frozen and loaded.words == ["red mug"] and loaded.threshold == 0.3
