//! Test harness for tests that need a GPU adapter. Without an adapter they are reported as ignored, or as failed if the
//! environment variable `CI` is set.

use libtest_mimic::{Arguments, Trial};
use std::process::ExitCode;

/// Runs the tests selected by the process's arguments, like the built-in harness.
pub(crate) fn run(trials: Vec<Trial>) -> ExitCode {
    libtest_mimic::run(&Arguments::from_args(), trials).exit_code()
}

/// A test that needs no adapter.
#[allow(dead_code, reason = "some binaries have none")]
pub(crate) fn on_host(name: &'static str, test: fn()) -> Trial {
    Trial::test(name, move || {
        test();
        Ok(())
    })
}

/// A test on the adapter shared by all tests of the process.
#[cfg(feature = "wgpu")]
#[allow(dead_code, reason = "some binaries have none")]
pub(crate) fn on_adapter(name: &'static str, test: fn(&std::sync::Arc<refsim::exec::gpu::Gpu>)) -> Trial {
    use libtest_mimic::Completion;
    Trial::ignorable_test(name, move || match refsim::exec::gpu::testing::shared()? {
        Some(gpu) => {
            test(&gpu);
            Ok(Completion::Completed)
        }
        None => Ok(Completion::ignored_with("no adapter")),
    })
}

/// Lists tests by path, which is also the test's name: `trials![on_host: valid::modules_are_valid]`.
macro_rules! trials {
    ($kind:ident: $($test:path),* $(,)?) => {
        vec![$($crate::adapter::$kind(stringify!($test), $test)),*]
    };
}
pub(crate) use trials;
