use crossbar_ground::linalg::dot;

#[test]
fn whole_numbers_come_out_exact_at_any_length() {
    for n in 0..40 {
        let a: Vec<f64> = (0..n).map(f64::from).collect();
        let b: Vec<f64> = (0..n).map(|k| f64::from(k % 5) - 2.0).collect();
        let sum: f64 = a.iter().zip(&b).map(|(x, y)| x * y).sum();
        assert_eq!(dot(&a, &b), sum);
        let longer: Vec<f64> = b.iter().copied().chain([7.0; 11]).collect();
        assert_eq!(dot(&longer, &a), sum);
    }
}
