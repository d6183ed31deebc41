//! The GPUs of this computer, and what their own single precision is worth.

use refsim::exec::gpu::{FULL_PROBE, Gpu, GpuError, OperationReport, Tally, adapters, probe as measure};

use crate::cli::{Out, Problem, Verdict};
use crate::report::Table;

/// `devices --adapters`
pub(super) fn list(out: &mut Out) -> miette::Result<()> {
    let adapters = adapters();
    if out.json() {
        return Ok(out.document(&adapters)?);
    }
    if adapters.is_empty() {
        out.line(GpuError::NoAdapter)?;
        return Ok(());
    }
    let mut table = Table::new("GPU adapters", &["adapter", "kind", "through", "driver", "largest buffer (bytes)"]);
    for adapter in adapters {
        table.push([
            adapter.name.into(),
            adapter.kind.to_string().into(),
            adapter.backend.into(),
            adapter.driver.into(),
            adapter.largest_buffer.into(),
        ]);
    }
    out.table(&table)?;
    Ok(())
}

/// `devices --probe`: fails if a result lies outside what WGSL allows.
pub(super) fn probe(name: &str, out: &mut Out) -> miette::Result<Verdict> {
    let refused = |e: GpuError| Problem::usage(e.to_string(), "`crossbar devices --adapters` lists the adapters");
    let gpu = Gpu::open(Some(name)).map_err(refused)?;
    let report = measure(&gpu, FULL_PROBE).map_err(refused)?;
    if out.json() {
        out.document(&report)?;
        return Ok(Verdict::held(report.conforms()));
    }
    out.line(format_args!("{}: single precision against IEEE 754", report.adapter))?;
    out.line("")?;
    let columns = ["operation", "numbers", "tried", "other bits", "outside WGSL", "most ULPs", "first difference"];
    let mut table = Table::new("Operations", &columns);
    for operation in &report.operations {
        for (class, tally) in classes(operation) {
            table.push([
                operation.name.into(),
                class.into(),
                tally.tried.into(),
                tally.different.into(),
                tally.outside.into(),
                tally.worst_ulps.into(),
                first(tally).into(),
            ]);
        }
    }
    out.table(&table)?;
    out.line("")?;
    let exact: Vec<&str> = report.operations.iter().filter(|o| o.exact()).map(|o| o.name).collect();
    let listed = if exact.is_empty() { "none".to_owned() } else { exact.join(", ") };
    out.line(format_args!("Equal to IEEE 754 in every bit: {listed}"))?;
    Ok(Verdict::held(report.conforms()))
}

fn classes(operation: &OperationReport) -> [(&'static str, &Tally); 3] {
    [("normal", &operation.normal), ("denormal", &operation.denormal), ("infinite or NaN", &operation.special)]
}

fn first(tally: &Tally) -> String {
    let Some(first) = &tally.first else { return String::new() };
    let operands: Vec<String> = first.operands.iter().map(|bits| format!("{bits:08x}")).collect();
    format!("{} -> {:08x}, not {:08x}", operands.join(" "), first.got, first.want)
}
