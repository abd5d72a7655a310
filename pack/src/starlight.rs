//! Light and colour of stars, from the numbers that catalogues have.

/// The light of a star over that of one of magnitude 0.
///
/// N. Pogson, "Magnitudes of Thirty-six of the Minor Planets for the first day of each month of the year 1857", 1856.
pub fn light_of_magnitude(magnitude: f64) -> f64 {
    libm::exp10(-0.4 * magnitude)
}

/// The temperature in kelvin of a black body of a B-V colour; the formula has poles below -0.5.
///
/// F. J. Ballesteros, "New insights into black bodies", EPL 97, 2012, (14).
pub fn temperature_k(colour_index: f64) -> f64 {
    let x = 0.92 * colour_index;
    4600.0 * (1.0 / (x + 1.7) + 1.0 / (x + 0.62))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_magnitudes_are_a_hundredth_and_the_sun_is_the_sun() {
        assert!((light_of_magnitude(5.0) - 0.01).abs() < 1e-15);
        // B-V 0.65 and 5772 K, within the fit's hundredth.
        assert!((temperature_k(0.65) / 5772.0 - 1.0).abs() < 0.01);
    }
}
