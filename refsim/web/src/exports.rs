//! Functions of the WebAssembly module. They take and return 32-bit integers, so that no memory is shared.

use std::cell::RefCell;

thread_local! {
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Appends a byte to the request.
#[expect(unsafe_code, reason = "an exported name")]
#[unsafe(no_mangle)]
pub extern "C" fn refsim_push(byte: u32) {
    REQUEST.with_borrow_mut(|request| request.push(byte as u8));
}

/// Answers the request and starts a new request; returns the length of the answer in bytes.
#[expect(unsafe_code, reason = "an exported name")]
#[unsafe(no_mangle)]
pub extern "C" fn refsim_answer() -> u32 {
    answered(crate::answer)
}

/// Answers a request about a shader in WGSL, in the same way. From the presence of this export, `crossbar page` knows
/// that the module accepts shaders.
#[cfg(feature = "wgsl")]
#[expect(unsafe_code, reason = "an exported name")]
#[unsafe(no_mangle)]
pub extern "C" fn refsim_shader() -> u32 {
    answered(crate::shader_answer)
}

fn answered(answer: impl Fn(&str) -> String) -> u32 {
    let request = REQUEST.take();
    let answer = answer(&String::from_utf8_lossy(&request)).into_bytes();
    let length = answer.len() as u32;
    ANSWER.set(answer);
    length
}

/// Four bytes of the answer from an index on, as a little-endian word; bytes past the end are 0.
#[expect(unsafe_code, reason = "an exported name")]
#[unsafe(no_mangle)]
pub extern "C" fn refsim_read(index: u32) -> u32 {
    let index = index as usize;
    let byte = |answer: &Vec<u8>, at: usize| answer.get(at).copied().unwrap_or_default();
    ANSWER.with_borrow(|answer| u32::from_le_bytes([0, 1, 2, 3].map(|k| byte(answer, index.saturating_add(k)))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_request_goes_in_and_its_answer_comes_out() {
        let request = r#"{"text": "ps_1_4\nmov r0, v0\n", "device": "r200", "pixel": [1, 2]}"#;
        request.bytes().for_each(|byte| refsim_push(byte.into()));
        let length = refsim_answer();
        let mut bytes: Vec<u8> = (0..length).step_by(4).flat_map(|at| refsim_read(at).to_le_bytes()).collect();
        bytes.truncate(length as usize);
        assert_eq!(String::from_utf8(bytes).expect("text"), crate::answer(request));
        assert_eq!((refsim_read(length), refsim_read(u32::MAX)), (0, 0));
        // The next request starts empty.
        let length = refsim_answer();
        assert!(length > 0 && crate::answer("").len() == length as usize);
    }
}
