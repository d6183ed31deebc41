use crossbar_ground::quadrature::integral;
use crossbar_ground::sphere::ParabolicMap;
use glam::DVec3;

#[test]
fn directions_and_coordinates_are_inverse() {
    let map = ParabolicMap::new(32);
    for (column, row) in [(0, 0), (16, 3), (31, 31)] {
        let direction = map.direction(column, row);
        assert!((direction.length() - 1.0).abs() < 4e-16);
        let expected = [column, row].map(|at| (at as f64 + 0.5) / 32.0);
        let found = ParabolicMap::coordinates_of(direction);
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{found:?} {expected:?}");
    }
    let below = DVec3::new(0.6, -0.48, -0.64);
    assert!((ParabolicMap::direction_at(ParabolicMap::coordinates_of(below)) - below).length() < 1e-15);
    assert_eq!(ParabolicMap::coordinates_of(DVec3::X), [1.0, 0.5], "columns run along x");
    assert_eq!(ParabolicMap::coordinates_of(DVec3::Y), [0.5, 1.0], "rows along y");
    assert_eq!(ParabolicMap::coordinates_of(DVec3::Z), [0.5, 0.5]);
    assert!((ParabolicMap::new(4096).direction(0, 0).z + 1.0 / 3.0).abs() < 1e-3, "the corner");
}

#[test]
fn interpolation_gives_texels_at_their_centers_and_planes_between() {
    let map = ParabolicMap::new(8);
    let value = |at: usize| 3.0 * (at % 8) as f64 - 2.0 * (at / 8) as f64;
    let read = |direction: DVec3| map.taps(direction).map(|(at, weight)| weight * value(at)).iter().sum::<f64>();
    for (column, row) in [(0, 0), (7, 7), (3, 5)] {
        assert!((read(map.direction(column, row)) - value(row * 8 + column)).abs() < 1e-12);
    }
    let between = DVec3::new(0.3, -0.2, (1.0_f64 - 0.13).sqrt());
    let [x, y] = ParabolicMap::coordinates_of(between).map(|at| 8.0 * at - 0.5);
    assert!((read(between) - (3.0 * x - 2.0 * y)).abs() < 1e-12);
    for map in [ParabolicMap::new(1), ParabolicMap::new(2), map] {
        for direction in [DVec3::X, DVec3::Z, DVec3::NEG_Z, DVec3::new(0.6, 0.0, -0.8), DVec3::NEG_Y] {
            let taps = map.taps(direction);
            assert!((taps.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-15);
            assert!(taps.iter().all(|&(at, weight)| at < map.texels() && (0.0..=1.0).contains(&weight)));
        }
    }
}

#[test]
fn solid_angles_are_the_integral_of_the_density() {
    let map = ParabolicMap::new(32);
    for (column, row) in [(0, 0), (16, 16), (31, 7)] {
        let edge = |at: usize| at as f64 / 16.0 - 1.0;
        let inner = |t: f64| {
            let density = |s: f64| 4.0 / ((1.0 + s * s + t * t) * (1.0 + s * s + t * t));
            integral(edge(column), edge(column + 1), density)
        };
        let expected = integral(edge(row), edge(row + 1), inner);
        let found = map.solid_angle(column, row);
        assert!((found - expected).abs() < 1e-15, "{column} {row}: {found} {expected}");
    }
}
