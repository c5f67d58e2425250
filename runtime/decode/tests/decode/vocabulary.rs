//! Vocabularies from files: what each form says of its tokens, and what is said of files that are none.

use motet_decode::vocabulary::{MAX_TOKEN_BYTES, MAX_TOKENS};
use motet_decode::{AcceptorFactory, EndToken, Environment, Subset, Vocabulary};
use serde_json::{Value, json};

fn read(file: &Value, end: EndToken<'_>) -> Result<Vocabulary, String> {
    Vocabulary::from_file(file.to_string().as_bytes(), end).map_err(|error| error.to_string())
}

fn bytes(vocabulary: &Vocabulary) -> Vec<&[u8]> {
    (0..u32::try_from(vocabulary.len()).unwrap()).map(|token| vocabulary.bytes(token)).collect()
}

#[test]
fn vocabulary_reads_byte_level_tokens() {
    let file = json!({
        "model": {"type": "BPE", "vocab": {"!": 0, "Ġgo": 1, "Ċ": 2, "Ã©": 3, "Ł": 4, "<|end|>": 5},
                  "merges": []},
        "pre_tokenizer": {"type": "Sequence", "pretokenizers": [{"type": "Split"}, {"type": "ByteLevel"}]},
        "added_tokens": [{"id": 5, "content": "<|end|>", "special": true},
                         {"id": 7, "content": "{\"é", "special": false}],
    });
    let vocabulary = read(&file, EndToken::Known).unwrap();
    let expected: [&[u8]; 8] = [b"!", b" go", b"\n", "é".as_bytes(), b"?", b"", b"", "{\"é".as_bytes()];
    assert_eq!(bytes(&vocabulary)[..4], expected[..4]);
    assert_eq!(bytes(&vocabulary)[5..], expected[5..]);
    assert_eq!(vocabulary.end(), 5);
}

#[test]
fn vocabulary_reads_every_byte_level_character() {
    // The table of GPT-2, built the other way around: printable bytes stand for themselves, the others
    // follow from U+0100.
    let mut next = 0x100;
    let mut vocab = serde_json::Map::new();
    for byte in 0..=255u32 {
        let plain = matches!(byte, 0x21..=0x7E | 0xA1..=0xAC | 0xAE..=0xFF);
        let character = if plain { byte } else { next };
        next += u32::from(!plain);
        vocab.insert(char::from_u32(character).unwrap().to_string(), byte.into());
    }
    vocab.insert("<|endoftext|>".to_owned(), 256.into());
    let file = json!({
        "model": {"vocab": vocab}, "decoder": {"type": "ByteLevel"},
        "added_tokens": [{"id": 256, "content": "<|endoftext|>", "special": true}],
    });
    let vocabulary = read(&file, EndToken::Known).unwrap();
    for byte in 0..=255u8 {
        assert_eq!(vocabulary.bytes(byte.into()), [byte]);
    }
}

#[test]
fn vocabulary_reads_pieces_with_byte_fallback() {
    let vocab = json!([
        ["<unk>", 0.0],
        ["<s>", 0.0],
        ["</s>", 0.0],
        ["<0x0A>", 0.0],
        ["▁pick", -1.0],
        ["\n", -2.0],
        ["é", -3.0]
    ]);
    let file = json!({
        "model": {"type": "Unigram", "unk_id": 0, "vocab": vocab, "byte_fallback": true},
        "added_tokens": [
            {"id": 0, "content": "<unk>", "special": true},
            {"id": 1, "content": "<s>", "special": true},
            {"id": 2, "content": "</s>", "special": true},
        ],
    });
    let vocabulary = read(&file, EndToken::Known).unwrap();
    let expected: [&[u8]; 7] = [b"", b"", b"", b"\n", b" pick", b"\n", "é".as_bytes()];
    assert_eq!(bytes(&vocabulary), expected);
    assert_eq!(vocabulary.end(), 2);
    let map = json!({
        "model": {"type": "BPE", "vocab": {"<unk>": 0, "▁a": 1, "<end>": 2}, "unk_token": "<unk>"},
        "decoder": {"type": "Sequence", "decoders": [
            {"type": "Replace", "pattern": {"String": "▁"}, "content": " "}, {"type": "ByteFallback"},
            {"type": "Fuse"}]},
    });
    assert_eq!(read(&map, EndToken::Known).unwrap_err(), "nothing says which token ends a sequence: name it");
    let vocabulary = read(&map, EndToken::Named("<end>")).unwrap();
    let expected: [&[u8]; 3] = [b"", b" a", b""];
    assert_eq!(bytes(&vocabulary), expected);
}

#[test]
fn vocabulary_reads_lists() {
    let list = json!(["{\"", [255, 0], null, "é"]);
    let vocabulary = read(&list, EndToken::Number(2)).unwrap();
    let expected: [&[u8]; 4] = [b"{\"", &[255, 0], b"", "é".as_bytes()];
    assert_eq!(bytes(&vocabulary), expected);
    let ranks = Vocabulary::from_file(b"eyI= 0\ngA== 2\n", EndToken::Number(3)).unwrap();
    let expected: [&[u8]; 4] = [b"{\"", b"", &[128], b""];
    assert_eq!(bytes(&ranks), expected);
    let lines = Vocabulary::from_file(b"eyI=\ngA==\n\n", EndToken::Number(2)).unwrap();
    let expected: [&[u8]; 3] = [b"{\"", &[128], b""];
    assert_eq!(bytes(&lines), expected);
}

#[test]
fn vocabulary_errors_name_the_reason() {
    let level = json!({"type": "ByteLevel"});
    let model = |vocab: Value| json!({"model": {"type": "BPE", "vocab": vocab}, "decoder": level});
    for (file, end, says) in [
        (json!({}), EndToken::Known, "`model` is not an object"),
        (json!({"model": []}), EndToken::Known, "`model` is not an object"),
        (
            json!({"model": {"type": "WordPiece", "vocab": {}}}),
            EndToken::Known,
            "`WordPiece`, whose tokens are not joined",
        ),
        (json!({"model": {"vocab": {"a": 0}}}), EndToken::Known, "BPE without ByteLevel or Metaspace"),
        (model(json!(3)), EndToken::Known, "`model.vocab` is not an object or a list"),
        (model(json!({"a": -1})), EndToken::Known, "`model.vocab.a` is not the number of a token"),
        (model(json!({"a": 4_294_967_295_u32})), EndToken::Known, "4294967296 tokens, at most 1048576"),
        (model(json!({"a": 1, "b": 1})), EndToken::Known, "token 1 is there twice"),
        (
            model(json!({"a b": 1})),
            EndToken::Known,
            "token 1 has the character ' ', which stands for no byte",
        ),
        (model(json!({"a": 0})), EndToken::Named("</s>"), "no token `</s>` to end"),
        (model(json!({"a": 0})), EndToken::Number(1), "no token 1 to end"),
        (model(json!({"a": 0})), EndToken::Number(0), "no token with bytes"),
        (model(json!({})), EndToken::Number(0), "no token 0 to end"),
        (json!(["a", 3]), EndToken::Number(0), "`1` is not a text, a list of bytes or null"),
        (json!(["a", [256]]), EndToken::Number(0), "`1` is not a text, a list of bytes or null"),
        (json!([]), EndToken::Number(0), "no token 0 to end"),
    ] {
        let said = read(&file, end).unwrap_err();
        assert!(said.contains(says), "{file}: {said}");
    }
    for (file, says) in [
        (&b"{\"model\": "[..], "is not JSON: EOF"),
        (b"", "no token with bytes"),
        (b"%%%\n", "line 1 is not a token in base64"),
        (b"YQ== 0\nYg== x\n", "line 2 is not a token in base64"),
        (b"YQ== 0\n\xff\n", "line 2 is not a token in base64"),
        (b"YQ== 4000000000\n", "at most 1048576"),
    ] {
        let said = Vocabulary::from_file(file, EndToken::Number(0)).unwrap_err().to_string();
        assert!(said.contains(says), "{}: {said}", String::from_utf8_lossy(file));
    }
    let deep = "[".repeat(100_000);
    assert!(Vocabulary::from_file(deep.as_bytes(), EndToken::Number(0)).is_err());
    let many = vec![b"a".to_vec(); MAX_TOKENS + 1];
    assert!(Vocabulary::from_tokens(many, 0).is_err());
    let long = vec![vec![b'a'; 200]; MAX_TOKEN_BYTES / 200 + 2];
    assert!(Vocabulary::from_tokens(long, 0).is_err());
}

#[test]
fn vocabulary_excludes_special_tokens_and_pairs_twins() {
    let mut tokens: Vec<Vec<u8>> = (0..=u8::MAX).map(|byte| vec![byte]).collect();
    tokens.extend([b"{".to_vec(), vec![b'a'; 2000], Vec::new(), b"ends".to_vec()]);
    let vocabulary = Vocabulary::from_tokens(tokens, 259).unwrap();
    let session = Environment { robot: Some("hsr"), scene: Some("kitchen"), ..Environment::default() }
        .session()
        .unwrap();
    let mut decoder = AcceptorFactory::new(&session, Subset::default()).decoder(&vocabulary, 2000).unwrap();
    let set = |mask: &[u32], token: usize| mask[token / 32] >> (token % 32) & 1 == 1;
    let mask = decoder.mask().to_vec();
    assert!(set(&mask, usize::from(b'{')) && set(&mask, 256));
    assert_eq!(mask.iter().map(|word| word.count_ones()).sum::<u32>(), 2);
    let policy = concat!(
        r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"#,
        r#""steps":[{"end":"done"}],"finally":null}"#,
    )
    .as_bytes();
    for byte in policy {
        assert!(!set(decoder.mask(), 257) && !set(decoder.mask(), 258) && !set(decoder.mask(), 259));
        assert!(
            !decoder.accept(257) && !decoder.accept(258) && !decoder.accept(259) && !decoder.accept(u32::MAX)
        );
        assert!(decoder.accept((*byte).into()));
    }
    // At the end the end may follow, and nothing else.
    let mask = decoder.mask().to_vec();
    assert!(set(&mask, 259));
    assert_eq!(mask.iter().map(|word| word.count_ones()).sum::<u32>(), 1);
    assert!(decoder.accept(259) && !decoder.accept(259));
    decoder.rollback(1);
    assert!(decoder.accept(259));
}

#[test]
fn environment_opens_by_name_and_by_text() {
    let error = |world: Environment<'_>| world.session().unwrap_err().to_string();
    assert!(
        error(Environment { robot: Some("hal"), ..Environment::default() })
            .contains("there is no robot `hal`; built in: ")
    );
    assert!(
        error(Environment { scene: Some("moon"), ..Environment::default() })
            .contains("there is no scene `moon`; built in: ")
    );
    assert!(
        error(Environment { scene: Some("{"), ..Environment::default() })
            .contains("the scene cannot be used: ")
    );
    assert!(
        error(Environment { robot: Some("a = "), ..Environment::default() })
            .contains("the robot cannot be used: ")
    );
    assert!(
        error(Environment { state: Some("[]"), ..Environment::default() })
            .contains("the state cannot be used: ")
    );
    assert!(
        error(Environment { domain: Some("kind"), ..Environment::default() })
            .contains("the domain cannot be used: ")
    );
    let scene = motet_robots::builtin::scene_text("kitchen").unwrap().json;
    let state = Some(r#"{"holding(mug_1)": true, "free(hand)": false}"#);
    let world = Environment { robot: Some("hsr"), scene: Some(scene), state, ..Environment::default() };
    let prepared = AcceptorFactory::new(&world.session().unwrap(), Subset::default());
    let head = r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"#;
    let pick = format!(r#"{head}"steps":[{{"do":"pick""#);
    let mut acceptor = prepared.acceptor(2000).unwrap();
    assert_eq!(acceptor.accept(head.as_bytes()), head.len());
    let mut acceptor = prepared.acceptor(2000).unwrap();
    assert!(acceptor.accept(pick.as_bytes()) < pick.len());
}
