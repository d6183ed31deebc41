//! Shaders in WGSL: translation, results, refusals.

mod accuracy;
#[path = "../common/adapter.rs"]
mod adapter;
mod builtins;
mod drawn;
mod half;
mod hostile;
#[cfg(feature = "wgpu")]
mod native;
mod rows;
mod texts;

fn main() -> std::process::ExitCode {
    let mut trials = adapter::trials![
        on_host: builtins::functions_compute_their_formulas,
        builtins::control_flow_keeps_the_values_of_each_fragment,
        accuracy::functions_are_as_accurate_as_wgsl_demands_in_f32,
        accuracy::functions_are_as_accurate_as_wgsl_demands_in_f16,
        half::rewritten_texts_have_the_bits_of_formats,
        half::rewritten_texts_as_they_are,
        half::some_operations_stay_single,
        half::straight_programs_compute_what_ieee_half_computes,
        texts::translations_as_they_are,
        texts::what_is_refused_says_where_and_why,
        texts::derivatives_in_uniform_control_flow_are_translated,
        texts::places_are_those_of_the_text,
        hostile::long_expressions_have_an_end,
        hostile::mutated_shaders_do_not_panic,
    ];
    #[cfg(feature = "wgpu")]
    trials.extend(adapter::trials![on_adapter: native::shaders_compute_what_a_driver_computes]);
    adapter::run(trials)
}
