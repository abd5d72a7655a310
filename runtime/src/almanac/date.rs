//! A moment of universal time, and its text.

use std::fmt;
use std::str::FromStr;

/// A moment of universal time (UTC, whose leap seconds are not counted), 1900-01-01T00:00:00Z to the last of 2099.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "String", into = "String"))]
pub struct Date {
    unix_s: f64,
}

/// Why a text or a number is no [`Date`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DateError {
    /// It has another form.
    #[error("expected a moment such as 2026-06-21T18:30:00Z or 2026-06-21T21:30+03:00")]
    Form,
    /// There is no such year, or positions are not known well enough.
    #[error("expected a year from {FIRST_YEAR} to {LAST_YEAR}")]
    Year,
    /// There is no such month.
    #[error("expected a month from 01 to 12")]
    Month,
    /// The month has fewer days.
    #[error("expected a day from 01 to {last}, since that month has no other")]
    Day {
        /// Its last day.
        last: u32,
    },
    /// There is no such time of day.
    #[error("expected a time of day from 00:00:00 to 23:59:59")]
    Clock,
    /// There is no such zone.
    #[error("expected Z or a time zone from -23:59 to +23:59 at the end")]
    Zone,
}

/// The first year.
pub const FIRST_YEAR: i64 = 1900;
/// The last year.
pub const LAST_YEAR: i64 = 2099;

const DAY_S: f64 = 86_400.0;
/// The Julian day of 1970-01-01T00:00:00Z.
const UNIX_JULIAN_DAY: f64 = 2_440_587.5;

impl Date {
    /// A moment by the seconds since 1970-01-01T00:00:00Z.
    ///
    /// # Errors
    /// [`DateError::Year`].
    pub fn from_unix_s(unix_s: f64) -> Result<Date, DateError> {
        let [first, end] = Date::ends_s();
        match (first..end).contains(&unix_s) {
            true => Ok(Date { unix_s }),
            false => Err(DateError::Year),
        }
    }

    /// Seconds since 1970-01-01T00:00:00Z.
    pub fn unix_s(self) -> f64 {
        self.unix_s
    }

    /// So many seconds later; it stays at the first or the last second where that would be beyond.
    pub fn after(self, seconds: f64) -> Date {
        let [first, end] = Date::ends_s();
        let seconds = if seconds.is_finite() { seconds } else { 0.0 };
        Date {
            unix_s: (self.unix_s + seconds).clamp(first, end - 1.0),
        }
    }

    /// The Julian day, with its fraction.
    pub fn julian_day(self) -> f64 {
        UNIX_JULIAN_DAY + self.unix_s / DAY_S
    }

    /// The year with its fraction.
    pub fn decimal_year(self) -> f64 {
        2000.0 + (self.julian_day() - 2_451_544.5) / 365.2425
    }

    fn ends_s() -> [f64; 2] {
        [FIRST_YEAR, LAST_YEAR + 1].map(|year| DAY_S * days_before_year(year) as f64)
    }
}

impl FromStr for Date {
    type Err = DateError;

    /// `YYYY-MM-DD`, then if need be `THH:MM`, `:SS` with a fraction, and `Z` or `+HH:MM`; without a zone it is universal time.
    fn from_str(text: &str) -> Result<Date, DateError> {
        let text = text.trim();
        let (day, clock) = match text.split_once(['T', 't', ' ']) {
            Some((day, clock)) => (day, Some(clock)),
            None => (text, None),
        };
        let days = days_of(day)?;
        let second = clock.map_or(Ok(0.0), second_of)?;
        Date::from_unix_s(days as f64 * DAY_S + second)
    }
}

impl fmt::Display for Date {
    /// To the millisecond, universal time.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let millis = (self.unix_s * 1e3).round() as i64;
        let (days, milli) = (millis.div_euclid(86_400_000), millis.rem_euclid(86_400_000));
        // No later than the year itself, whichever side of 1970 it is on.
        let mut year = 1970 + days.div_euclid(366).min(days.div_euclid(365));
        while days_before_year(year + 1) <= days {
            year += 1;
        }
        let mut day = days - days_before_year(year);
        let mut month = 1;
        while day >= i64::from(month_days(year, month)) {
            day -= i64::from(month_days(year, month));
            month += 1;
        }
        let (second, rest) = (milli / 1000, milli % 1000);
        let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
        write!(
            f,
            "{year:04}-{month:02}-{:02}T{hour:02}:{minute:02}:{second:02}",
            day + 1
        )?;
        if rest != 0 {
            write!(f, ".{rest:03}")?;
        }
        write!(f, "Z")
    }
}

impl TryFrom<String> for Date {
    type Error = DateError;

    fn try_from(text: String) -> Result<Date, DateError> {
        text.parse()
    }
}

impl From<Date> for String {
    fn from(date: Date) -> String {
        date.to_string()
    }
}

/// Days from 1970-01-01 to the first of a year, by the Gregorian calendar.
fn days_before_year(year: i64) -> i64 {
    let leaps = |last: i64| last.div_euclid(4) - last.div_euclid(100) + last.div_euclid(400);
    365 * (year - 1970) + leaps(year - 1) - leaps(1969)
}

fn month_days(year: i64, month: u32) -> u32 {
    match month {
        2 if days_before_year(year + 1) - days_before_year(year) == 366 => 29,
        2 => 28,
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

fn days_of(text: &str) -> Result<i64, DateError> {
    let parts: Vec<&str> = text.split('-').collect();
    let [year, month, day] = parts[..] else {
        return Err(DateError::Form);
    };
    let (year, month, day) = (digits(year, 4)?, digits(month, 2)?, digits(day, 2)?);
    let year = i64::from(year);
    if !(FIRST_YEAR..=LAST_YEAR).contains(&year) {
        return Err(DateError::Year);
    }
    if !(1..=12).contains(&month) {
        return Err(DateError::Month);
    }
    let last = month_days(year, month);
    if !(1..=last).contains(&day) {
        return Err(DateError::Day { last });
    }
    let before: u32 = (1..month).map(|m| month_days(year, m)).sum();
    Ok(days_before_year(year) + i64::from(before + day) - 1)
}

/// Seconds of universal time since midnight: a zone may take them to the day before or after.
fn second_of(text: &str) -> Result<f64, DateError> {
    let zone_at = text.find(['Z', 'z', '+', '-']).unwrap_or(text.len());
    let (clock, zone) = text.split_at(zone_at);
    let zone_s = match zone.as_bytes() {
        [] | [b'Z' | b'z'] => 0.0,
        [b'+', ..] => zone_s(&zone[1..])?,
        [b'-', ..] => -zone_s(&zone[1..])?,
        _ => return Err(DateError::Zone),
    };
    let parts: Vec<&str> = clock.split(':').collect();
    let (hour, minute, second) = match parts[..] {
        [hour, minute] => (hour, minute, "00"),
        [hour, minute, second] => (hour, minute, second),
        _ => return Err(DateError::Form),
    };
    let (whole, fraction) = match second.split_once('.') {
        Some((whole, fraction)) => (whole, fraction_of(fraction)?),
        None => (second, 0.0),
    };
    let (hour, minute, whole) = (digits(hour, 2)?, digits(minute, 2)?, digits(whole, 2)?);
    if hour > 23 || minute > 59 || whole > 59 {
        return Err(DateError::Clock);
    }
    Ok(f64::from(3600 * hour + 60 * minute + whole) + fraction - zone_s)
}

fn zone_s(text: &str) -> Result<f64, DateError> {
    let (hour, minute) = match text.len() {
        5 => text.split_once(':').ok_or(DateError::Zone)?,
        4 if text.is_ascii() => text.split_at(2),
        2 => (text, "00"),
        _ => return Err(DateError::Zone),
    };
    let number = |text| digits(text, 2).map_err(|_| DateError::Zone);
    let (hour, minute) = (number(hour)?, number(minute)?);
    match hour <= 23 && minute <= 59 {
        true => Ok(f64::from(3600 * hour + 60 * minute)),
        false => Err(DateError::Zone),
    }
}

fn digits(text: &str, count: usize) -> Result<u32, DateError> {
    match text.len() == count && text.bytes().all(|b| b.is_ascii_digit()) {
        true => text.parse().map_err(|_| DateError::Form),
        false => Err(DateError::Form),
    }
}

fn fraction_of(text: &str) -> Result<f64, DateError> {
    match (1..=9).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit()) {
        true => format!("0.{text}").parse().map_err(|_| DateError::Form),
        false => Err(DateError::Form),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn date(text: &str) -> Date {
        text.parse().unwrap_or_else(|e| panic!("{text}: {e}"))
    }

    #[test]
    fn julian_days_are_those_of_the_book() {
        // Meeus, "Astronomical Algorithms", 1998, page 62.
        for (text, day) in [
            ("2000-01-01T12:00:00Z", 2_451_545.0),
            ("1999-01-01", 2_451_179.5),
            ("1987-01-27T00:00Z", 2_446_822.5),
            ("1987-06-19T12:00:00Z", 2_446_966.0),
            ("1988-06-19T12:00:00Z", 2_447_332.0),
            ("1900-01-01", 2_415_020.5),
        ] {
            assert_eq!(date(text).julian_day(), day, "{text}");
        }
    }

    #[test]
    fn texts_come_back() {
        for text in [
            "1900-01-01T00:00:00Z",
            "1969-12-31T23:59:59.999Z",
            "1970-01-01T00:00:00Z",
            "2000-02-29T12:34:56Z",
            "2024-12-31T00:00:00Z",
            "2026-06-21T18:30:00Z",
            "2099-12-31T23:59:59Z",
        ] {
            assert_eq!(date(text).to_string(), text);
        }
        // Every day has its own, in order.
        let mut day = date("1900-01-01");
        for _ in 0..73_048 {
            let next = day.after(86_400.0);
            assert_eq!(date(&day.to_string()), day);
            assert!(day.to_string() < next.to_string());
            day = next;
        }
        assert_eq!(day.to_string(), "2099-12-31T00:00:00Z");
    }

    #[test]
    fn zones_are_taken_off_across_midnight_and_the_year() {
        for (text, same) in [
            ("2026-06-21T21:30+03:00", "2026-06-21T18:30:00Z"),
            ("2026-06-21 18:30", "2026-06-21T18:30:00Z"),
            ("2025-12-31T20:00:00-0500", "2026-01-01T01:00:00Z"),
            ("2026-01-01T00:30+14", "2025-12-31T10:30:00Z"),
            ("2026-06-21t18:30:00.25z", "2026-06-21T18:30:00.250Z"),
        ] {
            assert_eq!(date(text).to_string(), same);
        }
    }

    #[test]
    fn what_is_wrong_is_told() {
        for (text, error) in [
            ("", DateError::Form),
            ("noon", DateError::Form),
            ("2026-6-21", DateError::Form),
            ("2026-06-21T18", DateError::Form),
            ("2026-06-21T18:30:00.Z", DateError::Form),
            ("+026-06-21", DateError::Form),
            ("2026-06-2\u{661}", DateError::Form),
            ("1899-12-31", DateError::Year),
            ("2100-01-01", DateError::Year),
            ("0000-01-01", DateError::Year),
            ("2099-12-31T23:59:59-01:00", DateError::Year),
            ("2026-13-01", DateError::Month),
            ("2026-00-01", DateError::Month),
            ("2025-02-29", DateError::Day { last: 28 }),
            ("2024-02-30", DateError::Day { last: 29 }),
            ("2026-06-00", DateError::Day { last: 30 }),
            ("2026-06-21T24:00", DateError::Clock),
            ("2026-06-21T23:60", DateError::Clock),
            ("2026-06-21T23:59:60Z", DateError::Clock),
            ("2026-06-21T18:30+24:00", DateError::Zone),
            ("2026-06-21T18:30Zulu", DateError::Zone),
            ("2026-06-21T18:30+\u{e9}\u{e9}", DateError::Zone),
        ] {
            assert_eq!(text.parse::<Date>(), Err(error), "{text}");
        }
        for unix_s in [f64::NAN, f64::INFINITY, -1e12, 1e12] {
            assert_eq!(Date::from_unix_s(unix_s), Err(DateError::Year));
        }
    }

    #[test]
    fn time_that_goes_on_stays_in_its_range() {
        let last = date("2099-12-31T00:00:00Z").after(1e12);
        assert_eq!(last.to_string(), "2099-12-31T23:59:59Z");
        assert_eq!(last.after(-1e12).to_string(), "1900-01-01T00:00:00Z");
        assert_eq!(last.after(f64::NAN), last);
    }
}
