//! The `crossbar` program.

fn main() -> std::process::ExitCode {
    crossbar::cli::main()
}
