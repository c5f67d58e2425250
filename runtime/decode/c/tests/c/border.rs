//! Mistakes of hosts are errors: null pointers, wrong lengths, texts that are not UTF-8.

use std::ffi::{CStr, CString, c_char};
use std::ptr::{null, null_mut};

use motetdecode::*;

fn said() -> String {
    let said = motet_last_error();
    if said.is_null() { String::new() } else { unsafe { CStr::from_ptr(said) }.to_str().unwrap().to_owned() }
}

fn taken(string: *mut c_char) -> String {
    assert!(!string.is_null(), "{}", said());
    let text = unsafe { CStr::from_ptr(string) }.to_str().unwrap().to_owned();
    unsafe { motet_string_free(string) };
    text
}

fn environment(robot: &CStr, scene: *const c_char) -> *mut MotetEnvironment {
    let (robot, none) = (robot.as_ptr(), null());
    let texts = MotetEnvironmentTexts {
        robot,
        declarations: none,
        scene,
        state: none,
        domain: none,
        modifiers: false,
        text: false,
    };
    unsafe { motet_environment_new(&raw const texts) }
}

/// Every byte, then the end.
fn vocabulary() -> *mut MotetVocabulary {
    let bytes: Vec<u8> = (0..=u8::MAX).collect();
    let mut tokens: Vec<MotetBytes> = bytes.iter().map(|byte| MotetBytes { data: byte, len: 1 }).collect();
    tokens.push(MotetBytes { data: null(), len: 0 });
    unsafe { motet_vocabulary_new(tokens.as_ptr(), tokens.len(), 256) }
}

#[test]
fn null_is_an_error() {
    unsafe {
        assert!(motet_environment_new(null()).is_null());
        assert_eq!(said(), "the environment is null");
        assert!(motet_environment_check(null(), null(), 0).is_null());
        assert!(motet_vocabulary_new(null(), 3, 0).is_null());
        assert_eq!(said(), "there is no address of the tokens");
        assert!(motet_vocabulary_new(null(), 0, 0).is_null());
        assert_eq!(said(), "the vocabulary has no token 0 to end a sequence with");
        assert!(motet_vocabulary_read(null(), 1, 0).is_null());
        assert_eq!(motet_vocabulary_mask_words(null()), 0);
        assert!(motet_decoder_new(null(), null(), 100).is_null());
        assert!(motet_decoder_clone(null_mut()).is_null());
        assert_eq!(motet_decoder_mask(null_mut(), null_mut(), 0), MotetStatus::Error);
        assert_eq!(motet_decoder_accept(null_mut(), 0), MotetStatus::Error);
        assert_eq!(motet_decoder_rollback(null_mut(), 0), MotetStatus::Error);
        assert_eq!(motet_decoder_is_accepting(null_mut()), MotetStatus::Error);
        assert!(motet_decoder_forced(null_mut()).is_null());
        assert!(motet_decoder_text(null_mut()).is_null());
        assert!(motet_decoder_why_not(null_mut(), null(), 0).is_null());
        motet_string_free(null_mut());
        motet_environment_free(null_mut());
        motet_vocabulary_free(null_mut());
        motet_decoder_free(null_mut());
    }
}

#[test]
fn wrong_values_are_errors() {
    assert!(environment(c"hal", null()).is_null());
    assert!(said().starts_with("there is no robot `hal`"), "{}", said());
    assert!(environment(c"\xff", null()).is_null());
    assert_eq!(said(), "the robot is no UTF-8");
    let huge = MotetBytes { data: c"x".as_ptr().cast(), len: usize::MAX };
    assert!(unsafe { motet_vocabulary_new(&raw const huge, 1, 0) }.is_null());
    assert_eq!(said(), "the token has more bytes than there can be");
    assert!(unsafe { motet_vocabulary_read(b"{".as_ptr(), 1, MOTET_END_KNOWN) }.is_null());
    assert!(said().starts_with("the vocabulary is not JSON"), "{}", said());
    assert!(unsafe { motet_vocabulary_read(b"[]".as_ptr(), 2, -7) }.is_null());
    assert_eq!(said(), "-7 is no token");
    let (environment, tokens) = (environment(c"hsr", c"kitchen".as_ptr()), vocabulary());
    assert_eq!(said(), "");
    unsafe {
        assert!(motet_decoder_new(environment, tokens, 10).is_null());
        assert_eq!(said(), "no policy has at most 10 bytes");
        let decoder = motet_decoder_new(environment, tokens, 1000);
        let mut mask = [u32::MAX; 8];
        assert_eq!(motet_decoder_mask(decoder, mask.as_mut_ptr(), 8), MotetStatus::Error);
        assert_eq!(said(), "the mask has room for 8 words and needs 9");
        let odd = mask.as_mut_ptr().cast::<u8>().add(1).cast();
        assert_eq!(motet_decoder_mask(decoder, odd, 2), MotetStatus::Error);
        motet_decoder_free(decoder);
        motet_vocabulary_free(tokens);
        motet_environment_free(environment);
    }
}

#[test]
fn policy_is_written() {
    let (environment, tokens) = (environment(c"hsr", c"kitchen".as_ptr()), vocabulary());
    unsafe {
        let decoder = motet_decoder_new(environment, tokens, 1000);
        // A decoder keeps what it needs.
        motet_vocabulary_free(tokens);
        assert_eq!(taken(motet_decoder_forced(decoder)), "{\"motet\":1,\"policy\":\"");
        let start = concat!(
            r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"#,
            r#""steps":[{"do":"go","to":"mug_1"},{"do":"pick","object":"mug_1","from":"auto"}"#,
        )
        .as_bytes();
        for byte in start {
            assert_eq!(motet_decoder_accept(decoder, u32::from(*byte)), MotetStatus::Ok);
        }
        let again = br#",{"do":"pick","object":"mug_2","from":"auto"}"#;
        assert!(taken(motet_decoder_why_not(decoder, again.as_ptr(), again.len())).contains("\"M0501\""));
        let mut mask = [u32::MAX; 12];
        assert_eq!(motet_decoder_mask(decoder, mask.as_mut_ptr(), mask.len()), MotetStatus::Ok);
        let open = u32::from(b',');
        assert!(mask[(open / 32) as usize] >> (open % 32) & 1 == 1);
        assert_eq!(mask[8..], [0; 4]);
        let other = motet_decoder_clone(decoder);
        assert_eq!(motet_decoder_accept(decoder, u32::from(b'x')), MotetStatus::Refused);
        assert_eq!(motet_decoder_accept(decoder, u32::from(b',')), MotetStatus::Ok);
        assert_eq!(motet_decoder_rollback(decoder, 1), MotetStatus::Ok);
        for byte in b",{\"end\":\"done\"}],\"finally\":null}" {
            assert_eq!(motet_decoder_is_accepting(decoder), MotetStatus::Refused);
            assert_eq!(motet_decoder_accept(decoder, u32::from(*byte)), MotetStatus::Ok);
        }
        assert_eq!(motet_decoder_is_accepting(decoder), MotetStatus::Ok);
        assert_eq!(motet_decoder_accept(decoder, 256), MotetStatus::Ok);
        let policy = CString::new(taken(motet_decoder_text(decoder))).unwrap();
        let said =
            taken(motet_environment_check(environment, policy.as_ptr().cast(), policy.as_bytes().len()));
        assert!(!said.contains("\"error\""), "{said}");
        assert_eq!(taken(motet_decoder_text(other)).as_bytes(), start);
        for decoder in [decoder, other] {
            motet_decoder_free(decoder);
        }
        motet_environment_free(environment);
    }
}
