//! Operations of the virtual machine: their numbers, and the names of their constants in `vm.wgsl`.

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
    DOT FETCH TRACE SUM
}

/// Operations with lower numbers are always included: they are cheap to compile.
const FIRST_COSTLY: u32 = DOT;

/// Names of the constants of operations that are always included.
pub(in crate::exec::wgsl) fn plain() -> impl Iterator<Item = String> {
    NAMES[..FIRST_COSTLY as usize].iter().map(|name| constant(name))
}

pub(in crate::exec::wgsl) fn all() -> impl Iterator<Item = String> {
    NAMES.iter().map(|name| constant(name))
}

/// Name of the part of an operation that is not always included.
pub(super) fn part(operation: u32) -> Option<String> {
    (operation >= FIRST_COSTLY).then(|| constant(NAMES[operation as usize]))
}

/// Name of an operation's constant in the shader.
pub(super) fn constant(name: &str) -> String {
    format!("VM_{name}")
}
