//! Drawing, and what becomes of what was drawn, at the same time: one thread draws ahead, all cores encode and write.
//!
//! # Practice
//! Whatever the number of threads, pictures are begun and told in one order. At once there are at most [`AHEAD`] pictures on the device and, of
//! pictures that came back, one a thread and [`SPARE`] more: memory does not grow with their number.

use std::collections::{BTreeMap, VecDeque};
use std::sync::mpsc::channel;

use anyhow::{Error, Result};

/// Pictures that are begun before the first of them is waited for.
const AHEAD: usize = 3;

/// Pictures that wait for a thread.
const SPARE: usize = 2;

/// What comes next.
pub enum Next<B> {
    /// A picture that was begun.
    Begun(B),
    /// Nothing yet.
    Later,
    /// Nothing any more.
    End,
}

/// Begins pictures, waits for each, finishes them on all cores, and tells of them in the order in which they were begun. `begin` is asked with
/// whether it may wait for something to begin.
///
/// # Errors
/// The first of those of the four. What was begun before is finished and told all the same.
pub fn overlap<B, W: Send, F: Send>(
    mut begin: impl FnMut(bool) -> Result<Next<B>>,
    mut wait: impl FnMut(B) -> Result<W>,
    finish: impl Fn(W) -> Result<F> + Sync,
    mut tell: impl FnMut(F) -> Result<()>,
) -> Result<()> {
    let most = rayon::current_num_threads() + SPARE;
    let (sender, finished) = channel();
    let finish = &finish;
    let mut ahead = VecDeque::new();
    let mut order = Order::default();
    let (mut handed, mut running, mut ended) = (0, 0, false);
    let mut fault: Option<Error> = None;
    rayon::in_place_scope(|scope| {
        loop {
            while !ended && ahead.len() < AHEAD {
                match begin(ahead.is_empty() && running == 0) {
                    Ok(Next::Begun(begun)) => ahead.push_back(begun),
                    Ok(Next::Later) => break,
                    Ok(Next::End) => ended = true,
                    Err(error) => {
                        ended = true;
                        fault.get_or_insert(error);
                    }
                }
            }
            let oldest = ahead.pop_front();
            if oldest.is_none() && running == 0 && ended {
                break;
            }
            // What is finished is told at once; it is waited for where there is no room for one more, or nothing else to do.
            let mut idle = oldest.is_none() && running > 0;
            loop {
                let received = match idle || running == most {
                    true => finished.recv().ok(),
                    false => finished.try_recv().ok(),
                };
                let Some((place, done)) = received else { break };
                (running, idle) = (running - 1, false);
                if let Err(error) = order.add(place, done, &mut tell) {
                    ended = true;
                    fault.get_or_insert(error);
                }
            }
            let Some(oldest) = oldest else { continue };
            match wait(oldest) {
                Ok(back) => {
                    let (sender, place) = (sender.clone(), handed);
                    (handed, running) = (handed + 1, running + 1);
                    // The receiver is there until all are received.
                    scope.spawn(move |_| drop(sender.send((place, finish(back)))));
                }
                Err(error) => {
                    ended = true;
                    fault.get_or_insert(error);
                }
            }
        }
    });
    let rest = order.rest(&mut tell);
    fault.map_or(rest, Err)
}

/// What is finished, until all before it is.
struct Order<F> {
    next: usize,
    held: BTreeMap<usize, Option<F>>,
}

impl<F> Default for Order<F> {
    fn default() -> Order<F> {
        Order {
            next: 0,
            held: BTreeMap::new(),
        }
    }
}

impl<F> Order<F> {
    /// Takes what is finished, and tells what has nothing missing before it.
    fn add(
        &mut self,
        place: usize,
        done: Result<F>,
        tell: &mut impl FnMut(F) -> Result<()>,
    ) -> Result<()> {
        let (held, failed) = match done {
            Ok(finished) => (Some(finished), Ok(())),
            Err(error) => (None, Err(error)),
        };
        self.held.insert(place, held);
        while let Some(held) = self.held.remove(&self.next) {
            self.next += 1;
            if let Some(finished) = held {
                tell(finished)?;
            }
        }
        failed
    }

    /// Tells what is left.
    fn rest(self, tell: &mut impl FnMut(F) -> Result<()>) -> Result<()> {
        self.held.into_values().flatten().try_for_each(tell)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    use anyhow::anyhow;

    use super::*;

    /// What is told of `count` pictures of which some fail.
    fn told(
        count: usize,
        fails: impl Fn(&str, usize) -> bool + Sync,
    ) -> (Vec<usize>, Option<String>) {
        let mut told = Vec::new();
        let mut numbers = 0..count;
        let failed = |step: &str, i: usize| match fails(step, i) {
            true => Err(anyhow!("{step} {i}")),
            false => Ok(i),
        };
        let done = overlap(
            |_| match numbers.next() {
                Some(i) => failed("begin", i).map(Next::Begun),
                None => Ok(Next::End),
            },
            |i| failed("wait", i),
            |i| {
                // Later ones are ready sooner.
                std::thread::sleep(Duration::from_micros(300 * (7 - i as u64 % 7)));
                failed("finish", i)
            },
            |i| {
                told.push(i);
                Ok(())
            },
        );
        (told, done.err().map(|error| error.to_string()))
    }

    #[test]
    fn pictures_are_told_in_the_order_in_which_they_were_begun() {
        for count in [0, 1, 2, 100] {
            assert_eq!(told(count, |_, _| false), ((0..count).collect(), None));
        }
    }

    #[test]
    fn what_was_begun_before_a_fault_is_told_and_nothing_is_begun_after_it() {
        for step in ["begin", "wait", "finish"] {
            let (told, fault) = told(1000, |at, i| at == step && i == 40);
            assert_eq!(fault, Some(format!("{step} 40")));
            assert_eq!(told[..40], (0..40).collect::<Vec<_>>());
            assert!(!told.contains(&40) && told.len() < 100 + rayon::current_num_threads());
        }
    }

    #[test]
    fn no_more_pictures_are_held_than_was_said() {
        let (held, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let mut numbers = 0..200;
        overlap(
            |_| {
                let next = numbers.next();
                if next.is_some() {
                    let now = held.fetch_add(1, Ordering::SeqCst) + 1;
                    most.fetch_max(now, Ordering::SeqCst);
                }
                Ok(next.map_or(Next::End, Next::Begun))
            },
            Ok,
            |_: i32| {
                std::thread::sleep(Duration::from_millis(1));
                held.fetch_sub(1, Ordering::SeqCst);
                Ok(())
            },
            |()| Ok(()),
        )
        .unwrap();
        let bound = AHEAD + rayon::current_num_threads() + SPARE;
        let most = most.into_inner();
        assert!((2..=bound).contains(&most), "{most} of {bound}");
    }

    #[test]
    fn what_is_there_is_finished_while_more_is_awaited() {
        // As from a pipe whose writer waits for each picture.
        let told = std::cell::Cell::new(0);
        let mut begun = 0;
        overlap(
            |may_wait| {
                if begun == 3 {
                    return Ok(Next::End);
                }
                if told.get() < begun {
                    assert!(!may_wait, "nothing would ever come");
                    return Ok(Next::Later);
                }
                begun += 1;
                Ok(Next::Begun(begun))
            },
            Ok,
            Ok,
            |_| {
                told.set(told.get() + 1);
                Ok(())
            },
        )
        .unwrap();
        assert_eq!(told.get(), 3);
    }
}
