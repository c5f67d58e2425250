"""The logits processor, over arrays of numpy as generate would call it."""

import motet
import numpy
import pytest
from motet.transformers import MotetLogitsProcessor


def generate(decoder, rows, random, most=400):
    """Greedy search over random logits after a prompt; the padding is the token 0."""
    prompt = numpy.full((rows, 3), 7)
    processor, ids, pad = MotetLogitsProcessor(decoder), prompt, 0
    # Models have more logits than tokenizers have tokens.
    width = len(decoder.vocabulary) + 5
    over = numpy.zeros(rows, dtype=bool)
    while not over.all() and ids.shape[1] < most + 3:
        scores = processor(ids, random.normal(size=(rows, width)))
        assert (scores[~over, len(decoder.vocabulary) :] == -numpy.inf).all()
        chosen = numpy.where(over, pad, scores.argmax(axis=1))
        over |= chosen == decoder.vocabulary.end
        ids = numpy.hstack([ids, chosen[:, None]])
    texts = []
    for row in ids[:, 3:]:
        tokens = row.tolist()
        assert decoder.vocabulary.end in tokens
        tokens = tokens[: tokens.index(decoder.vocabulary.end)]
        texts.append(b"".join(decoder.vocabulary.token(token) for token in tokens).decode())
    return texts


def test_batches_of_policies_check(environment, tokenizer):
    decoder = motet.Decoder(environment=environment, tokenizer=tokenizer, budget=399)
    texts = generate(decoder, rows=4, random=numpy.random.default_rng(3))
    assert len(set(texts)) == 4
    for text in texts:
        wrong = [said for said in environment.check(text) if said["severity"] == "error"]
        assert not wrong, (text, wrong)
    assert decoder.text == ""


def test_beams_may_change_places(environment, tokenizer):
    decoder = motet.Decoder(environment=environment, tokenizer=tokenizer)
    processor = MotetLogitsProcessor(decoder)
    scores = numpy.zeros((2, len(decoder.vocabulary)))
    open_brace, both = ord("{"), decoder.vocabulary.tokenize(b'{"')[0]
    processor(numpy.zeros((2, 0), dtype=int), scores)
    first = processor(numpy.array([[open_brace], [both]]), scores)
    swapped = processor(numpy.array([[both, ord("m")], [open_brace, ord('"')]]), scores)
    assert (first[0] > -1).nonzero()[0].tolist() == [ord('"')]
    assert decoder.vocabulary.token(int(swapped[0].argmax())).startswith(b"o")
    assert decoder.vocabulary.token(int(swapped[1].argmax())).startswith(b"m")
    with pytest.raises(ValueError, match="does not follow"):
        processor(numpy.array([[both, ord("x")], [open_brace, ord('"')]]), scores)
