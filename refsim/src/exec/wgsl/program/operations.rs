//! Operations of the machine: their numbers in words, and the constants by which `vm.wgsl` knows them.

macro_rules! operations {
    ($($name:ident)*) => {
        #[derive(Clone, Copy)]
        #[expect(non_camel_case_types, clippy::upper_case_acronyms, reason = "the names of the shader's constants")]
        enum OperationNumber { $($name,)* }
        $(pub(super) const $name: u32 = OperationNumber::$name as u32;)*
        /// Names in the order of their numbers.
        pub(super) const NAMES: &[&str] = &[$(stringify!($name)),*];
    };
}

operations! {
    END ENTER UNLESS ZERO ALU LONG COPY AND OR AND_NOT SELECT FETCHED
    DOT RELATIVE FETCH TRACE
    STEP IF ELSE END_IF LOOP END_LOOP BREAK CALL RET LABEL
}

/// Operations below are in every machine: they cost compilers little.
const FIRST_COSTLY: u32 = DOT;
/// Operations from here on come and go together.
const FIRST_FLOW: u32 = STEP;

/// The constants of the operations that every machine has.
pub(in crate::exec::wgsl) fn plain() -> impl Iterator<Item = String> {
    NAMES[..FIRST_COSTLY as usize].iter().map(|name| constant(name))
}

/// The constants of all operations.
pub(in crate::exec::wgsl) fn all() -> impl Iterator<Item = String> {
    NAMES.iter().map(|name| constant(name))
}

/// The operations that a machine must have for one of them.
pub(super) fn with(operation: u32) -> &'static [&'static str] {
    match operation {
        FIRST_FLOW.. => &NAMES[FIRST_FLOW as usize..],
        FIRST_COSTLY.. => &NAMES[operation as usize..=operation as usize],
        _ => &[],
    }
}

/// The constant that means an operation in the shader.
pub(super) fn constant(name: &str) -> String {
    format!("VM_{name}")
}
