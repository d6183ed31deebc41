//! Properties of the assembler: it parses what it prints, and never panics.

use crate::{asm::texts, generate, spacing};
use proptest::prelude::*;
use refsim::asm::{ErrorKind, MAX_ERRORS, MAX_STATEMENTS, MAX_TEXT, assemble, print};

/// A place, the kind of an edit, and a byte for it.
pub(crate) type Edit = (prop::sample::Index, u8, u8);

/// A text with bytes removed, doubled or replaced, and pieces repeated.
pub(crate) fn mutated(mut bytes: Vec<u8>, edits: Vec<Edit>) -> Vec<u8> {
    for (at, kind, byte) in edits {
        if bytes.is_empty() {
            break;
        }
        let at = at.index(bytes.len());
        match kind {
            0 => drop(bytes.remove(at)),
            1 => bytes.insert(at, bytes[at]),
            2 => bytes[at] = byte & 0x7f,
            _ => {
                let end = (at + usize::from(byte)).min(bytes.len());
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
        }
    }
    bytes
}

/// Checks the properties that hold for any text.
pub(crate) fn survives(text: &str) {
    match assemble(text) {
        Ok(program) => {
            let printed = print(&program);
            assert_eq!(assemble(&printed).as_ref(), Ok(&program), "{printed}");
        }
        Err(found) => {
            assert!(!found.errors.is_empty(), "an error says what is wrong");
            assert!(found.errors.len() <= MAX_ERRORS + 1, "the list is bounded");
            for error in &found.errors {
                let range = error.span.start as usize..error.span.end as usize;
                assert!(text.get(range).is_some(), "{error:?} points into the text");
                assert!(!error.help.is_empty() && !error.expected.is_empty(), "{error:?}");
            }
            let starts: Vec<_> = found.errors.iter().map(|e| e.span.start).collect();
            assert!(starts.is_sorted(), "errors come in the order of the text");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1024))]

    #[test]
    fn printed_programs_read_back(seed in any::<u64>()) {
        let program = generate::anything(seed);
        let text = print(&program);
        let again = assemble(&text);
        prop_assert_eq!(again.as_ref(), Ok(&program), "{}", text);
        prop_assert_eq!(print(&again.unwrap()), text);
    }

    #[test]
    fn no_text_has_two_readings(
        seed in any::<u64>(),
        spaces in prop::collection::vec(any::<usize>(), 0..300),
    ) {
        let mut spaces = spaces.into_iter();
        let choose = |n| spaces.next().unwrap_or(0) % n;
        spacing::has_one_reading(&print(&generate::anything(seed)), &[" ", "\t", " /* mov r0, 1.5 */ "], choose);
    }

    #[test]
    fn any_bytes_are_survived(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        survives(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn any_text_after_a_version_is_survived(text in "ps_2_a\n(\\PC|[ \n,.+_()!-]|r0|mov |def c0|if_gt |c\\[a0){0,80}") {
        survives(&text);
    }

    #[test]
    fn mutated_programs_are_survived(
        which in any::<prop::sample::Index>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0u8..4, any::<u8>()), 1..8),
    ) {
        let texts = texts("asm");
        let bytes = mutated(which.get(&texts).1.clone().into_bytes(), edits);
        survives(&String::from_utf8_lossy(&bytes));
    }
}

#[test]
fn every_prefix_of_a_program_is_survived() {
    for (_, text) in texts("asm") {
        for end in (0..=text.len()).filter(|&end| text.is_char_boundary(end)) {
            survives(&text[..end]);
        }
    }
}

#[test]
fn giant_inputs_are_refused_in_time() {
    let kind = |text: &str| assemble(text).expect_err("too much").errors.last().map(|e| e.kind);
    let too_long = "ps_1_4\n".to_owned() + &" ".repeat(MAX_TEXT);
    assert_eq!(kind(&too_long), Some(ErrorKind::TextTooLong));
    let statements = "ps_1_4\n".to_owned() + &"nop\n".repeat(MAX_STATEMENTS + 1);
    assert_eq!(kind(&statements), Some(ErrorKind::TooManyStatements));
    let most = "ps_1_4\n".to_owned() + &"nop\n".repeat(MAX_STATEMENTS);
    assert_eq!(assemble(&most).map(|p| p.instructions.len()), Ok(MAX_STATEMENTS));
    for piece in ["?\n", "mov r0, ", "?,", "+", "(", "[", "/*", "1", "c[", "-", "_", "a\n", "e", "def c0,\n"] {
        survives(&("ps_1_4\n".to_owned() + &piece.repeat(300_000 / piece.len())));
        survives(&("ps_1_4\nmad r0, ".to_owned() + &piece.repeat(300_000 / piece.len())));
        survives(&("ps_1_4\ndef c0, ".to_owned() + &piece.repeat(300_000 / piece.len())));
    }
    let bad = "ps_1_4\n".to_owned() + &"?\n".repeat(2 * MAX_ERRORS);
    assert_eq!(kind(&bad), Some(ErrorKind::TooManyErrors));
}
