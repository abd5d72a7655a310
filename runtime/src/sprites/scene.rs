//! What of a field is drawn in a frame: the CPU's part, without a device.
//!
//! # Practice
//! Everything that a frame needs is allocated once, when the field or the distance of sight changes.

use glam::{DVec3, Vec2, Vec3, Vec4};
use welkin_pack::Field;
use welkin_pack::field::SECTION_SIDE_M;

use super::grid::{BlockId, around, slots_a_side};
use super::instances::{INSTANCES_PER_ROW, Instance, Section, sections};
use super::locks::Locks;
use super::order::{Order, Station};
use super::{formation, outline};
use crate::params::SkyParams;

/// Texels a side of the texture of amounts: one for each of the most clouds of a field would be 65536.
pub const AMOUNTS_SIDE: u32 = 256;

/// A field, ready to be drawn.
#[derive(Debug)]
pub struct Scene {
    sections: Vec<Section>,
    a_side: usize,
    ranks: Vec<f32>,
    /// How far each cloud has formed, in 255ths, as the device reads it: a row of 256 clouds after the other.
    pub amounts: Vec<u8>,
    /// The sections that each cloud has sprites in.
    sections_of: Vec<Vec<u16>>,
    /// Counts how often the clouds that show in a section have changed.
    versions: Vec<u32>,
    /// The lowest and the highest edge of a cloud, in metres.
    pub heights_m: [f64; 2],
    /// How far sprites reach over the sides of their blocks, in metres.
    pub overhang_m: f32,
    slots: Vec<Slot>,
    slots_a_side: usize,
    locks: Locks,
    order: Order,
    staging: Vec<Instance>,
    rows_a_slot: u32,
}

/// What a slot of the device's texture holds.
#[derive(Clone, Copy, Debug, Default)]
struct Slot {
    holds: Option<(BlockId, Station, u32, [f32; 2])>,
    stale: bool,
    count: u32,
}

/// Sprites of a block to be drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw {
    /// Number of the first of them in the texture.
    pub first: u32,
    /// How many there are.
    pub count: u32,
    /// From the viewpoint to the block's corner, in metres.
    pub origin: Vec3,
    /// From the field's corner to that of the block's section, to the east and south, in metres.
    pub section: Vec2,
    /// Opacity of the block.
    pub opacity: f32,
    /// Vertices of each sprite: [`outline::VERTICES`] or [`outline::BOX`].
    pub vertices: usize,
}

impl Scene {
    /// A field with no slot yet.
    pub fn new(field: &Field) -> Scene {
        let sections = sections(field);
        let mut sections_of = vec![Vec::new(); field.clouds.len()];
        for (number, section) in sections.iter().enumerate() {
            for instance in &section.instances {
                let list: &mut Vec<u16> = &mut sections_of[instance.cloud()];
                if list.last() != Some(&(number as u16)) {
                    list.push(number as u16);
                }
            }
        }
        let heights = sections.iter().filter_map(|section| section.heights_m);
        let heights = heights.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
        let most = sections.iter().map(|s| s.instances.len()).max();
        let rows_a_slot = (most.unwrap_or(0) as u32)
            .div_ceil(INSTANCES_PER_ROW)
            .max(1);
        let most = (rows_a_slot * INSTANCES_PER_ROW) as usize;
        Scene {
            a_side: field.sections.max(1) as usize,
            ranks: field.clouds.iter().map(|cloud| cloud.rank).collect(),
            amounts: vec![0; field.clouds.len().next_multiple_of(AMOUNTS_SIDE as usize)],
            sections_of,
            versions: vec![0; sections.len()],
            heights_m: heights.unwrap_or([0.0; 2]).map(f64::from),
            overhang_m: sections.iter().map(|s| s.overhang_m).fold(0.0, f32::max),
            slots: Vec::new(),
            slots_a_side: 0,
            locks: Locks::default(),
            order: Order::with_capacity(most),
            staging: Vec::with_capacity(most),
            rows_a_slot,
            sections,
        }
    }

    /// Rows of the texture that a slot has: as many as the block with the most sprites needs.
    pub fn rows_a_slot(&self) -> u32 {
        self.rows_a_slot
    }

    /// How far clouds are seen, in metres: as far as asked, or as far as a texture of so many rows lets it.
    pub fn sight_m(&self, distance_m: f32, most_rows: u32) -> f32 {
        let fits = |distance: f32| self.rows(distance) <= most_rows;
        let mut distance = distance_m;
        while !fits(distance) && distance > SECTION_SIDE_M {
            distance -= 0.5 * SECTION_SIDE_M;
        }
        distance
    }

    /// Rows of the texture for a distance of sight.
    pub fn rows(&self, distance_m: f32) -> u32 {
        (slots_a_side(distance_m).pow(2) as u32).saturating_mul(self.rows_a_slot)
    }

    /// Makes the slots for a distance of sight, all of them empty. True if they are others than before.
    pub fn fit(&mut self, distance_m: f32) -> bool {
        let side = slots_a_side(distance_m);
        if side == self.slots_a_side {
            return false;
        }
        self.slots_a_side = side;
        self.slots = vec![Slot::default(); side * side];
        true
    }

    /// Lets clouds form for a moment. True if an amount changed.
    pub fn form(&mut self, params: &SkyParams, seconds: f64) -> bool {
        let mut changed = false;
        for (index, rank) in self.ranks.iter().enumerate() {
            let amount = formation::amount(index, *rank, params, seconds);
            let byte = (amount * 255.0).round() as u8;
            let before = self.amounts[index];
            changed |= before != byte;
            self.amounts[index] = byte;
            if (before == 0) != (byte == 0) {
                for &section in &self.sections_of[index] {
                    self.versions[usize::from(section)] += 1;
                }
            }
        }
        changed
    }

    /// Locks the sprites that a viewer in the field is near to.
    pub fn lock(&mut self, viewer_m: DVec3) {
        let reach = f64::from(self.overhang_m);
        for block in around(viewer_m, reach) {
            let corner = block.corner_m();
            let viewer = viewer_m - DVec3::new(corner.x, 0.0, corner.y);
            let section = &self.sections[block.index(self.a_side)];
            for (index, instance) in section.instances.iter().enumerate() {
                if instance.lies_flat() || instance.is_billboard() {
                    continue;
                }
                let to_viewer = viewer - instance.centre_m().as_dvec3();
                let radius = f64::from(instance.radius_m());
                if self.locks.see(block, index as u32, to_viewer, radius) {
                    self.slots[block.index(self.slots_a_side)].stale = true;
                }
            }
        }
        self.locks.keep(|block| block.distance_m(viewer_m) <= reach);
    }

    /// Forgets what it knows of earlier frames.
    pub fn reset_history(&mut self) {
        self.locks.clear();
        self.slots.iter_mut().for_each(|slot| slot.stale = true);
    }

    /// The draw of a block for a viewer in the field; `view` looks from `viewpoint_m`. `upload` takes a slot's first row and whole rows of
    /// instances when they have changed. None if there is nothing to draw.
    ///
    /// `billboards_m` are the distances between which sprites change to billboards.
    pub fn draw(
        &mut self,
        block: BlockId,
        viewer_m: DVec3,
        viewpoint_m: DVec3,
        share: f32,
        billboards_m: [f32; 2],
        upload: impl FnOnce(u32, &[Instance]),
    ) -> Option<Draw> {
        let section = block.index(self.a_side);
        if self.sections[section].instances.is_empty() {
            return None;
        }
        let slot = block.index(self.slots_a_side);
        let station = Station::of(viewer_m, block.distance_m(viewer_m));
        let wanted = Some((block, station, self.versions[section], billboards_m));
        if self.slots[slot].holds != wanted || self.slots[slot].stale {
            self.stage(block, station, billboards_m);
            let count = self.staging.len();
            let whole_rows = count.next_multiple_of(INSTANCES_PER_ROW as usize);
            self.staging.resize(whole_rows, Instance::default());
            upload(slot as u32 * self.rows_a_slot, &self.staging);
            self.slots[slot] = Slot {
                holds: wanted,
                stale: false,
                count: count as u32,
            };
        }
        let corner = block.corner_m();
        let origin = DVec3::new(corner.x, 0.0, corner.y) - viewpoint_m;
        let count = self.slots[slot].count;
        let distance_m = block.distance_of_middle_m(viewpoint_m);
        let is_far = distance_m > f64::from(outline::BOXES_BEYOND_M);
        (count > 0).then(|| Draw {
            first: slot as u32 * self.rows_a_slot * INSTANCES_PER_ROW,
            count,
            origin: origin.as_vec3(),
            section: SECTION_SIDE_M
                * Vec2::new(
                    (section % self.a_side) as f32,
                    (section / self.a_side) as f32,
                ),
            opacity: share,
            vertices: if is_far {
                outline::BOX
            } else {
                outline::VERTICES
            },
        })
    }

    /// The sprites of a block that show, in the order of a station, into `staging`.
    fn stage(&mut self, block: BlockId, station: Station, [change_m, billboards_m]: [f32; 2]) {
        let corner = block.corner_m();
        let from = (station.place_m() - DVec3::new(corner.x, 0.0, corner.y)).as_vec3();
        let instances = &self.sections[block.index(self.a_side)].instances;
        let amounts = &self.amounts;
        // The viewer may be as far from the station as it is coarse.
        let slack = station.slack_m();
        let sorted = self.order.sorted(instances, from, |instance, distance| {
            let in_reach = if instance.is_billboard() {
                distance > change_m - slack
            } else {
                distance < billboards_m + slack
            };
            in_reach && amounts[instance.cloud()] > 0
        });
        self.staging.clear();
        for index in sorted {
            let mut instance = instances[index as usize];
            instance.lock = self
                .locks
                .of(block, index)
                .map_or([0; 4], |lock| lock.facing);
            self.staging.push(instance);
        }
    }

    /// Share of the sun's light that reaches a viewer through the sprites before it. `viewer_m` is in the field; sprites beyond
    /// `distance_m` do not count.
    pub fn clear_towards(&self, sun: Vec3, viewer_m: DVec3, distance_m: f64, opacity: f32) -> f32 {
        let mut clear = 1.0;
        let flat = Vec3::new(sun.x, 0.0, sun.z).length().max(1e-3);
        let top = (self.heights_m[1] - viewer_m.y).max(0.0) as f32;
        let reach =
            f64::from(top / sun.y.max(1e-3) * flat).min(distance_m) + f64::from(self.overhang_m);
        for block in around(viewer_m, reach) {
            let corner = block.corner_m();
            let from = (viewer_m - DVec3::new(corner.x, 0.0, corner.y)).as_vec3();
            let middle = Vec3::new(0.5, 0.0, 0.5) * SECTION_SIDE_M - from;
            // Off the sun's line on the ground by more than half a diagonal and the overhang.
            let off = (middle.x * sun.z - middle.z * sun.x).abs() / flat;
            if off > 0.7072 * SECTION_SIDE_M + self.overhang_m {
                continue;
            }
            for instance in &self.sections[block.index(self.a_side)].instances {
                let amount = f32::from(self.amounts[instance.cloud()]) / 255.0;
                if amount == 0.0 || instance.is_billboard() {
                    continue;
                }
                let to = instance.centre_m() - from;
                let along = to.dot(sun);
                let off = (to - along * sun).length() / instance.radius_m();
                if along > 0.0 && off < 0.8 {
                    // About the mean opacity of a sprite of the sheet, thinner outwards.
                    clear *= 1.0 - 0.7 * opacity * amount * (1.0 - off / 0.8);
                }
            }
        }
        clear
    }

    /// Half the diagonal of what a block's sprites fill, about the block's middle at the middle of the heights, and that height, in
    /// metres.
    pub fn bounds_m(&self) -> (f32, f32) {
        let [low, high] = self.heights_m.map(|h| h as f32);
        let side = 0.5 * SECTION_SIDE_M + self.overhang_m;
        let up = 0.5 * (high - low);
        ((2.0 * side * side + up * up).sqrt(), 0.5 * (low + high))
    }

    /// Whether a block may be seen from a place between planes through that place, whose normals look inwards.
    pub fn is_in_view(&self, block: BlockId, viewpoint_m: DVec3, planes: &[Vec3]) -> bool {
        let corner = block.corner_m();
        let origin = (DVec3::new(corner.x, 0.0, corner.y) - viewpoint_m).as_vec3();
        let (radius, height) = self.bounds_m();
        let middle = origin + Vec3::new(0.5 * SECTION_SIDE_M, height, 0.5 * SECTION_SIDE_M);
        planes
            .iter()
            .all(|plane| plane.dot(middle) >= -radius * plane.length())
    }
}

/// The planes of the sides of a view, whose normals look inwards, from its clip rows.
pub fn planes(clip_x: Vec4, clip_y: Vec4, clip_w: Vec4) -> [Vec3; 5] {
    let [x, y, w] = [clip_x, clip_y, clip_w].map(Vec4::truncate);
    [w + x, w - x, w + y, w - y, w]
}
