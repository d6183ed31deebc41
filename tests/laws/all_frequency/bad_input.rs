//! Impossible lights and transfer are refused.

use crossbar::all_frequency::transfer::FactoredTransfer;
use crossbar::picture::Picture;
use crossbar::sphere::{ClearSky, EnvironmentPicture};
use crossbar::tracer::HostTracer;
use crossbar::transfer::light::{CubeLight, DiskSource};
use crossbar::transfer::linear_basis::{BasisWidth, LinearBasis};
use crossbar::transfer::visibility::VisibilityMaps;
use glam::{DMat3, DVec3};

use super::{clutter, trace, vertices};

#[test]
fn what_is_no_light_is_refused() {
    assert!(CubeLight::new(vec![[0.0; 3]; 6143]).is_err(), "a texel is missing");
    let mut texels = vec![[0.0; 3]; 6144];
    for bad in [f64::NAN, -1.0, f64::INFINITY] {
        texels[2 * 1024 + 5 * 32 + 7][1] = bad;
        let error = CubeLight::new(texels.clone()).expect_err("refused").to_string();
        let place = format!("found {bad} in channel green of face 2, row 5, column 7 (counted from 0)");
        assert!(error.ends_with(&place), "{error}");
    }
    let good = DiskSource { towards: DVec3::Z, radius: 1.0, radiance: [1.0; 3] };
    for bad in [
        DiskSource { towards: DVec3::ZERO, ..good },
        DiskSource { radius: 0.0, ..good },
        DiskSource { radius: f64::NAN, ..good },
        DiskSource { radiance: [1.0, -1.0, 0.0], ..good },
    ] {
        assert!(CubeLight::from_disks(&[good, bad], &DMat3::IDENTITY).is_err());
    }
    let mirror = DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0));
    assert!([mirror, DMat3::ZERO].iter().all(|matrix| CubeLight::from_disks(&[], matrix).is_err()));
    let night = ClearSky { sun: -DVec3::Z, sun_radiance: [1.0; 3], zenith: [1.0; 3], ground: [0.0; 3] };
    assert!(CubeLight::sky(&night).is_err());
    let mut pixels = vec![[1.0; 3]; 64 * 32];
    pixels[2 * 64 + 33] = [-1.0; 3];
    let picture = EnvironmentPicture::new(&Picture::rgb(64, 32, &pixels)).expect("an environment");
    assert!(CubeLight::from_picture(&picture).is_err());
    assert!(EnvironmentPicture::new(&Picture::rgb(65, 32, &[])).is_err());
}

#[test]
fn what_is_no_transfer_is_refused() {
    let mesh = clutter(1, 3, 1.0);
    let vertices = vertices(&mesh);
    let mut caster = HostTracer::new(&mesh, crossbar::geom::Sides::Both);
    assert!(VisibilityMaps::trace(&vertices, &[0, 9], &mut caster, &mut |_, _| ()).is_err(), "nine vertices");
    let (maps, hats) = (trace(&mesh, &vertices, &[2, 5]), LinearBasis::new(BasisWidth::OneTexel));
    let other = super::vertices(&clutter(1, 1, 1.0));
    let elsewhere = FactoredTransfer {
        vertices: &other,
        maps: &maps,
        hats: &hats,
        rows: 1,
        response: &|_: DVec3, _: &mut [f64]| (),
    };
    assert!(elsewhere.segment(0).is_err());
    let response = |_: DVec3, into: &mut [f64]| into.fill(f64::NAN);
    let transfer = FactoredTransfer { vertices: &vertices, maps: &maps, hats: &hats, rows: 2, response: &response };
    assert!(transfer.segments().any(|segment| segment.is_err()), "a NaN");
}
