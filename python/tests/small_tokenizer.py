"""A small tokenizer that the tests make themselves: byte-level, with pieces that cross the borders of words."""

PIECES = ['{"', '":"', '","', '":{"', '":[{"', '"}', '"},{"', '"}]', '"}]}', '}]}', "null", 'do":"', 'end":"done"}', 'go"']
PIECES += ["pick", 'detect","what":"', "mug", 'mug_1"', "$m", '"$', "1.5", "99", "an", " and", "kitchen", "user", '"fail"']
END = "<|endoftext|>"


def characters():
    """The character that stands for each byte."""
    plain = [*range(0x21, 0x7F), *range(0xA1, 0xAD), *range(0xAE, 0x100)]
    others = [byte for byte in range(256) if byte not in plain]
    return {byte: chr(byte) for byte in plain} | {byte: chr(0x100 + at) for at, byte in enumerate(others)}


def tokenizer_json():
    of_byte = characters()
    tokens = [bytes([byte]) for byte in range(256)] + [piece.encode() for piece in PIECES]
    vocab = {"".join(of_byte[byte] for byte in token): number for number, token in enumerate(tokens)}
    vocab[END] = len(vocab)
    return {
        "version": "1.0",
        "added_tokens": [{"id": vocab[END], "content": END, "special": True, "single_word": False, "lstrip": False,
                          "rstrip": False, "normalized": False}],
        "normalizer": None,
        "pre_tokenizer": {"type": "ByteLevel", "add_prefix_space": False, "trim_offsets": True, "use_regex": True},
        "post_processor": None,
        "decoder": {"type": "ByteLevel", "add_prefix_space": False, "trim_offsets": True, "use_regex": True},
        "model": {"type": "BPE", "vocab": vocab, "merges": []},
    }
