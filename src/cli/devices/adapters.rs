//! The GPUs of this computer.

use refsim::exec::gpu::{GpuError, adapters};

use crate::cli::Out;
use crate::report::Table;

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
