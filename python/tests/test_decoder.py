"""Decoders over random logits: from any weights, what is written checks."""

import sys

import motet
import numpy
import pytest

START = '{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"steps":['


def feed(decoder, text):
    for byte in text.encode():
        assert decoder.accept(byte), decoder.text


def write(decoder, random, scale):
    """Samples from a softmax of random logits, as from a model with random weights."""
    bias = random.normal(size=len(decoder.vocabulary)) * scale
    while not decoder.is_over:
        logits = random.normal(size=len(bias)) + bias
        allowed = decoder.allowed()
        assert allowed.any(), decoder.text
        logits[~allowed] = -numpy.inf
        weights = numpy.exp(logits - logits.max())
        assert decoder.accept(int(random.choice(len(weights), p=weights / weights.sum())))
    return decoder.text


@pytest.mark.parametrize("scale", [0.0, 1.0, 5.0])
def test_random_policy_checks(environment, tokenizer, scale):
    start = motet.Decoder(environment=environment, tokenizer=tokenizer, budget=500)
    for seed in range(6):
        policy = write(start.clone(), numpy.random.default_rng(seed), scale)
        wrong = [said for said in environment.check(policy) if said["severity"] == "error"]
        assert not wrong, (seed, policy, wrong)
        assert len(policy) <= 500


@pytest.mark.parametrize("effort", [0, 2000])
def test_a_policy_under_wide_masks_checks(environment, tokenizer, effort):
    for seed in range(3):
        random = numpy.random.default_rng(seed)
        decoder = motet.Decoder(environment=environment, tokenizer=tokenizer, budget=500)
        while not decoder.is_over:
            token = int(random.choice(numpy.flatnonzero(decoder.allowed(effort))))
            is_wide = decoder.is_wide
            if not decoder.accept(token):
                assert is_wide and not decoder.allowed(effort)[token]
        wrong = [said for said in environment.check(decoder.text) if said["severity"] == "error"]
        assert not wrong, (seed, decoder.text, wrong)


def test_a_wide_mask_lacks_the_token_that_was_refused(environment, tokenizer):
    decoder = motet.Decoder(environment=environment, tokenizer=tokenizer)
    feed(decoder, START + '{"do":"')
    pick = [decoder.vocabulary.token(token) for token in range(len(decoder.vocabulary))].index(b"pick")
    assert decoder.allowed(0)[pick] and decoder.is_wide
    assert not decoder.accept(pick)
    assert not decoder.allowed(0)[pick] and decoder.is_wide
    assert not decoder.allowed()[pick] and not decoder.is_wide
    feed(decoder, "go")


def test_a_mask_is_taken_by_numpy(environment, tokenizer):
    decoder = motet.Decoder(environment=environment, tokenizer=tokenizer)
    mask = decoder.mask()
    words = numpy.asarray(mask)
    assert words.dtype == numpy.uint32 and len(words) == -(-len(decoder.vocabulary) // 32)
    bits = [bool(mask[token // 32] >> (token % 32) & 1) for token in range(len(decoder.vocabulary))]
    assert decoder.allowed().tolist() == bits
    assert [decoder.vocabulary.token(token) for token, may in enumerate(bits) if may] == [b"{", b'{"']


def test_a_policy_is_followed_forced_and_taken_back(environment, tokenizer):
    decoder = motet.Decoder(environment=environment, tokenizer=tokenizer)
    assert decoder.forced() == '{"motet":1,"policy":"'
    feed(decoder, START + '{"do":"go","to":"mug_1"},{"do":"pick","object":"mug_1","from":"auto"}')
    again = ',{"do":"pick","object":"mug_2","from":"auto"}'
    assert "M0501" in [said["code"] for said in decoder.why_not(again)]
    assert decoder.why_not(',{"do":"go","to":"user"}') == []
    other = decoder.clone()
    assert not decoder.accept(ord("x")) and not decoder.accept(-1) and not decoder.accept(10**6)
    feed(decoder, ",{")
    decoder.rollback(2)
    assert decoder.text == other.text and decoder.tokens == other.tokens
    feed(decoder, ',{"end":"done"}],"finally":null}')
    assert decoder.is_accepting and not decoder.is_over and not other.is_accepting
    assert decoder.allowed().nonzero()[0].tolist() == [decoder.vocabulary.end]
    assert decoder.accept(decoder.vocabulary.end) and decoder.is_over
    assert not decoder.allowed().any()
    assert not [said for said in decoder.check(decoder.text) if said["severity"] == "error"]


def test_environments_are_of_names_files_and_values(tmp_path, tokenizer):
    held = motet.Decoder(
        robot="hsr", scene="kitchen", state={"holding(mug_1)": True, "free(hand)": False}, tokenizer=tokenizer
    )
    feed(held, START + '{"do":"p')
    assert not held.accept(ord("i"))
    with pytest.raises(ValueError, match="there is no robot `hal`; built in: "):
        motet.Environment(robot="hal")
    with pytest.raises(ValueError, match="the state cannot be used"):
        motet.Environment(robot="hsr", state={"holding": 3})
    with pytest.raises(ValueError, match="no policy has at most 3 bytes"):
        motet.Decoder(robot="hsr", tokenizer=tokenizer, budget=3)
    (tmp_path / "wrong.json").write_text("{}")
    with pytest.raises(ValueError, match="`model` is not an object"):
        motet.vocabulary(tmp_path / "wrong.json")
    with pytest.raises(ValueError, match="no tokenizer: int"):
        motet.vocabulary(3)


def test_vocabularies_of_files_and_encodings(tmp_path):
    (tmp_path / "ranks").write_bytes(b"eyI= 0\ngA== 1\n")
    ranks = motet.vocabulary(tmp_path / "ranks", end=2)
    assert (len(ranks), ranks.end, ranks.token(0), ranks.token(1), ranks.token(2)) == (3, 2, b'{"', b"\x80", b"")
    with pytest.raises(ValueError, match="no encoding"):
        motet.Vocabulary.of_encoding("p50k")
    assert motet.Vocabulary.from_tokens([b"a", b""], 1).tokenize(b"aa") == [0, 0]


def test_torch_is_not_imported():
    import motet.transformers  # noqa: F401

    assert "torch" not in sys.modules and "transformers" not in sys.modules
