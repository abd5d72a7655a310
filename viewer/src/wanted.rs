//! Which of several GPUs a person wants, in words.

use std::fmt;
use std::str::FromStr;

/// A graphics adapter, as `welkin-view gpus` lists it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Its number.
    Number(usize),
    /// Its address on the PCI bus, which tells equal cards apart and stays when others come and go: `0000:65:00.0`.
    BusId(String),
}

impl FromStr for Wanted {
    type Err = String;

    fn from_str(text: &str) -> Result<Wanted, String> {
        if let Ok(number) = text.parse() {
            return Ok(Wanted::Number(number));
        }
        let groups: Vec<&str> = text.split([':', '.']).collect();
        let is_hex = |group: &&str| group.chars().all(|c| c.is_ascii_hexdigit());
        let lengths: Vec<usize> = groups.iter().map(|group| group.len()).collect();
        match groups.iter().all(is_hex) && lengths == [4, 2, 2, 1] {
            true => Ok(Wanted::BusId(text.to_lowercase())),
            false => Err(
                "expected a number or a PCI bus id of those that `welkin-view gpus` lists, such as 0 or 0000:65:00.0"
                    .to_string(),
            ),
        }
    }
}

impl fmt::Display for Wanted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Wanted::Number(number) => write!(f, "number {number}"),
            Wanted::BusId(id) => write!(f, "at PCI bus id {id}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_bus_ids_are_told_apart_and_all_else_is_refused() {
        assert_eq!("1".parse(), Ok(Wanted::Number(1)));
        let id = Wanted::BusId("0000:6a:00.0".to_string());
        assert_eq!("0000:6A:00.0".parse(), Ok(id));
        for text in [
            "",
            "-1",
            "65:00.0",
            "0000:65:00",
            "0000:6g:00.0",
            "nvidia",
            "0000.65.00:0:",
        ] {
            let error = text.parse::<Wanted>().unwrap_err();
            assert!(error.contains("welkin-view gpus"), "{text}: {error}");
        }
    }
}
