//! What a value is drawn from: a constant, a range, a normal distribution, a choice.

use serde_json::Value;
use toml::Value as Toml;

use super::fault::Fault;
use super::stream::Stream;

/// What a value is drawn from.
#[derive(Clone, Debug, PartialEq)]
pub enum Spread {
    /// Always this.
    Constant(Value),
    /// Evenly between two numbers, whole ones with both ends.
    Uniform { ends: [f64; 2], whole: bool },
    /// A normal distribution, of which what lies beyond the ends is drawn again.
    Normal {
        mean: f64,
        deviation: f64,
        ends: [f64; 2],
    },
    /// One of these, with weights that add up to the last one.
    Choice(Vec<(Value, f64)>),
}

/// How many deviations from the mean the ends may begin: beyond that hardly any number is between them.
const MOST_DEVIATIONS: f64 = 4.0;

/// As often a number is drawn again. At four deviations about a number in 16,000 would be taken.
const MOST_DRAWS: u32 = 1_000_000;

/// What a number may be.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    /// The least and the most.
    pub ends: [f64; 2],
    /// Whether only whole numbers count.
    pub whole: bool,
}

impl Spread {
    /// Reads what a key has; `numbers` says which it may have, if it may have numbers at all.
    pub fn read(key: &str, value: &Toml, numbers: Option<Numbers>) -> Result<Spread, Fault> {
        const EXPECTED: &str = "a value, or one of {uniform = [a, b]}, {normal = [mean, deviation]} with within = [a, b] if need be, {choice = [...]} with weights = [...] if need be";
        let Toml::Table(table) = value else {
            return Ok(Spread::Constant(plain(key, value)?));
        };
        let part = |name: &str| format!("{key}.{name}");
        let known = ["uniform", "normal", "within", "choice", "weights"];
        if let Some(other) = table.keys().find(|name| !known.contains(&name.as_str())) {
            return Err(Fault::value(&part(other), &table[other], EXPECTED));
        }
        let of = |name: &str| table.get(name).map(|value| (part(name), value));
        let only = |names: &[&str]| table.keys().all(|name| names.contains(&name.as_str()));
        let range = || {
            numbers.ok_or_else(|| {
                Fault::value(key, value, "a value, or {choice = [...]}: it is no number")
            })
        };
        if let Some((name, ends)) = of("uniform").filter(|_| only(&["uniform"])) {
            let Numbers { whole, .. } = range()?;
            let ends = pair(&name, ends)?;
            return Ok(Spread::Uniform { ends, whole });
        }
        if let Some((name, of_it)) = of("normal").filter(|_| only(&["normal", "within"])) {
            let numbers = range()?;
            let expected = "mean and deviation, the second above 0";
            let [mean, deviation] = two(&name, of_it, expected)?;
            if deviation <= 0.0 || numbers.whole {
                let expected = match numbers.whole {
                    true => "{uniform = [a, b]} or {choice = [...]}: only whole numbers count",
                    false => expected,
                };
                return Err(Fault::value(&name, of_it, expected));
            }
            let ends = match of("within") {
                Some((name, ends)) => pair(&name, ends)?,
                None => numbers.ends,
            };
            let nearest = mean.clamp(ends[0], ends[1]);
            if (nearest - mean).abs() > MOST_DEVIATIONS * deviation
                || ends[1] - ends[0] < 1e-3 * deviation
            {
                let expected = format!(
                    "a mean at most {MOST_DEVIATIONS} deviations from {} to {}, where its numbers may be, and a deviation not beyond all measure",
                    ends[0], ends[1]
                );
                return Err(Fault::value(&name, of_it, &expected));
            }
            return Ok(Spread::Normal {
                mean,
                deviation,
                ends,
            });
        }
        let choice = of("choice").filter(|_| only(&["choice", "weights"]));
        let (name, choice) = choice.ok_or_else(|| Fault::value(key, value, EXPECTED))?;
        let values = choice.as_array().filter(|values| !values.is_empty());
        let values = values.ok_or_else(|| Fault::value(&name, choice, "a list of values"))?;
        let weights = match of("weights") {
            None => vec![1.0; values.len()],
            Some((name, weights)) => {
                let list: Option<Vec<f64>> = weights
                    .as_array()
                    .and_then(|w| w.iter().map(number).collect());
                let is_weight = |list: &Vec<f64>| {
                    list.len() == values.len()
                        && list.iter().all(|w| (0.0..=1e9).contains(w))
                        && list.iter().sum::<f64>() > 0.0
                };
                list.filter(is_weight).ok_or_else(|| {
                    let expected = format!("{} numbers from 0 on, not all 0", values.len());
                    Fault::value(&name, weights, &expected)
                })?
            }
        };
        let mut sum = 0.0;
        let mut choices = Vec::new();
        for (value, weight) in values.iter().zip(weights) {
            sum += weight;
            choices.push((plain(&name, value)?, sum));
        }
        Ok(Spread::Choice(choices))
    }

    /// Values that it may give: all, or those at its ends.
    pub fn extremes(&self) -> Vec<Value> {
        match self {
            Spread::Constant(value) => vec![value.clone()],
            Spread::Uniform { ends, whole } => ends.map(|x| rounded(x, *whole)).to_vec(),
            Spread::Normal { ends, .. } => ends.map(|x| rounded(x, false)).to_vec(),
            Spread::Choice(choices) => choices.iter().map(|(value, _)| value.clone()).collect(),
        }
    }

    /// Draws a value.
    pub fn draw(&self, stream: &mut Stream) -> Value {
        match self {
            Spread::Constant(value) => value.clone(),
            Spread::Uniform {
                ends: [low, high],
                whole,
            } => {
                let steps = if *whole { high - low + 1.0 } else { high - low };
                let x = low + steps * stream.unit();
                between(if *whole { x.floor() } else { x }, [*low, *high], *whole)
            }
            Spread::Normal {
                mean,
                deviation,
                ends,
            } => {
                let mut x = *mean;
                for _ in 0..MOST_DRAWS {
                    x = mean + deviation * stream.normal();
                    if (ends[0]..=ends[1]).contains(&x) {
                        break;
                    }
                }
                between(x, *ends, false)
            }
            Spread::Choice(choices) => {
                let sum = choices.last().map_or(0.0, |(_, sum)| *sum);
                let at = sum * stream.unit();
                let drawn = choices.iter().find(|(_, sum)| at < *sum);
                drawn.map_or(Value::Null, |(value, _)| value.clone())
            }
        }
    }
}

/// A number of at most six decimals between two.
fn between(x: f64, [low, high]: [f64; 2], whole: bool) -> Value {
    rounded((1e6 * x).round().clamp(1e6 * low, 1e6 * high) / 1e6, whole)
}

fn rounded(x: f64, whole: bool) -> Value {
    match whole {
        true => Value::from(x as i64),
        // Not -0.
        false => Value::from(x + 0.0),
    }
}

/// A value as JSON has it: what may be chosen from.
fn plain(key: &str, value: &Toml) -> Result<Value, Fault> {
    match value {
        Toml::String(text) => Ok(Value::from(text.as_str())),
        Toml::Integer(number) => Ok(Value::from(*number)),
        Toml::Float(number) if number.is_finite() => Ok(Value::from(*number)),
        Toml::Boolean(on) => Ok(Value::from(*on)),
        Toml::Array(values) if !values.is_empty() => {
            let values = values.iter().map(|value| plain(key, value));
            Ok(Value::Array(values.collect::<Result<_, _>>()?))
        }
        other => Err(Fault::value(
            key,
            other,
            "a number, true or false, text, or a list of these",
        )),
    }
}

/// A number of a file.
pub fn number(value: &Toml) -> Option<f64> {
    let number = value.as_float().or(value.as_integer().map(|n| n as f64));
    number.filter(|n| n.is_finite())
}

/// Two numbers.
pub fn two(key: &str, value: &Toml, expected: &str) -> Result<[f64; 2], Fault> {
    let numbers = value
        .as_array()
        .map(|values| values.iter().map(number).collect::<Option<Vec<f64>>>());
    match numbers {
        Some(Some(numbers)) if numbers.len() == 2 => Ok([numbers[0], numbers[1]]),
        _ => Err(Fault::value(key, value, expected)),
    }
}

/// Two numbers, the second not below the first.
pub fn pair(key: &str, value: &Toml) -> Result<[f64; 2], Fault> {
    let expected = "two numbers, the lower first";
    let ends = two(key, value, expected)?;
    match ends[0] <= ends[1] {
        true => Ok(ends),
        false => Err(Fault::value(key, value, expected)),
    }
}
