//! Response spectrum of one sine wave of the ground, exact for a ground acceleration that is linear between its samples.
//!
//! Source of the right value: a stiff oscillator feels the ground, so that its acceleration is the peak of the ground.
//!
//!     cargo run --release -p heeltoe --example response_spectrum

use heeltoe::spectrum::spectrum;
use heeltoe::stop::Stop;
use std::f64::consts::TAU;

fn main() {
    let time: Vec<f64> = (0..=1000).map(|k| f64::from(k) * 0.002).collect();
    let ground: Vec<f64> = time
        .iter()
        .map(|t| if *t <= 1.0 { 3.0 * (TAU * t).sin() } else { 0.0 })
        .collect();
    let periods = [0.01, 0.1, 0.3, 1.0, 3.0];
    let peaks = spectrum(&time, &ground, &periods, 0.05, Stop::default());
    println!("period [s]  pseudo-acceleration [m/s2]");
    let accelerations: Vec<f64> = periods
        .iter()
        .zip(&peaks)
        .map(|(period, peak)| peak.displacement * (TAU / period).powi(2))
        .collect();
    for (period, acceleration) in periods.iter().zip(&accelerations) {
        println!("{period:10.2}  {acceleration:8.3}");
    }
    assert!((accelerations[0] - 3.0).abs() < 0.03);
    assert!(accelerations[3] > accelerations[0]);
}
