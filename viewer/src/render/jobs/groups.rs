//! Jobs in groups, of one picture or of as many as a tar file has: a group is there or is made as a whole.

use std::collections::VecDeque;

use anyhow::{Context, Result};

use super::index::Index;
use super::studio::Task;

/// A job in its place.
pub enum Placed {
    /// All of its group is there.
    Kept(String),
    /// To be drawn.
    Task(Box<Task>, Group),
}

/// What a picture's group is.
#[derive(Clone, Debug)]
pub struct Group {
    /// Its number, from 0.
    pub number: u64,
    /// How many pictures it has.
    pub count: usize,
    /// Names of files that an earlier run of the same jobs has made.
    pub own: Vec<String>,
}

/// Gathers jobs.
pub struct Groups {
    /// Jobs of a tar file; without it each is alone.
    size: Option<usize>,
    force: bool,
    number: u64,
    /// Jobs of the group that is gathered, and where each is.
    gathered: Vec<(Task, String)>,
    ready: VecDeque<Placed>,
}

impl Groups {
    pub fn new(size: Option<u32>, force: bool) -> Groups {
        Groups {
            size: size.map(|size| size as usize),
            force,
            number: 0,
            gathered: Vec::new(),
            ready: VecDeque::new(),
        }
    }

    /// The next job of a group that is complete.
    pub fn next(&mut self) -> Option<Placed> {
        self.ready.pop_front()
    }

    /// Whether nothing is gathered.
    pub fn is_empty(&self) -> bool {
        self.gathered.is_empty()
    }

    /// Takes a job, which is at `place`; `tar` names the file of a group.
    pub fn add(
        &mut self,
        (task, place): (Task, String),
        index: &Index,
        tar: impl Fn(u64) -> String,
    ) -> Result<()> {
        self.gathered.push((task, place));
        match self.gathered.len() >= self.size.unwrap_or(1) {
            true => self.end(index, tar),
            false => Ok(()),
        }
    }

    /// Ends the group that is gathered.
    pub fn end(&mut self, index: &Index, tar: impl Fn(u64) -> String) -> Result<()> {
        let gathered = std::mem::take(&mut self.gathered);
        let file = self.size.map(|_| tar(self.number));
        let (mut own, mut are_there) = (Vec::new(), true);
        for (task, place) in &gathered {
            let known = task
                .known(index, self.force)
                .with_context(|| place.clone())?;
            are_there &= task.is_there(known, file.as_deref());
            if let Some(known) = known {
                match &known.tar {
                    None => own.extend_from_slice(&known.files),
                    Some(tar) => own.push(tar.clone()),
                }
            }
        }
        let group = Group {
            number: self.number,
            count: gathered.len(),
            own,
        };
        self.number += 1;
        let placed = gathered.into_iter().map(|(task, _)| match are_there {
            true => Placed::Kept(task.name().to_string()),
            false => Placed::Task(Box::new(task), group.clone()),
        });
        self.ready.extend(placed);
        Ok(())
    }
}
