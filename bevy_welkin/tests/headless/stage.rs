//! An application of Bevy without a window: cameras draw into images, which are read back.

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

use bevy::app::PluginsState;
use bevy::asset::AssetPlugin;
use bevy::camera::{Hdr, RenderTarget};
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::log::LogPlugin;
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::gpu_readback::{Readback, ReadbackComplete};
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::render::render_resource::{TextureFormat, TextureUsages};
use bevy::render::settings::{WgpuFeatures, WgpuSettings};
use bevy::time::TimeUpdateStrategy;
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;
use bevy_welkin::welkin_pack::Pack;
use bevy_welkin::{DAYLIGHT, GlobalWelkinSky, WelkinPack, WelkinPlugin, WelkinSky, WelkinView};

use crate::scene;

/// Of a picture: rows are read back without gaps.
pub const SIZE: UVec2 = UVec2::new(256, 144);

/// The default pack, baked once.
pub fn pack() -> &'static Pack {
    static PACK: OnceLock<Pack> = OnceLock::new();
    PACK.get_or_init(|| scene::pack().expect("the default pack bakes"))
}

/// An application, one at a time: a software rasteriser has all cores already.
pub struct Stage {
    pub app: App,
    _alone: MutexGuard<'static, ()>,
}

/// What a camera has drawn: linear radiance or display light, rows from the top.
#[derive(Clone, Debug)]
pub struct Picture {
    pub size: UVec2,
    pub pixels: Vec<Vec3>,
    /// As the target holds it, if that has bytes.
    pub bytes: Vec<u8>,
}

#[derive(Component, Default)]
struct Shot(Vec<u8>);

impl Stage {
    /// With the folder that assets are loaded from, which is watched.
    pub fn new(assets: &str) -> Stage {
        Stage::with(assets, |_| {})
    }

    /// The same with more plugins.
    pub fn with(assets: &str, more: impl FnOnce(&mut App)) -> Stage {
        static ALONE: Mutex<()> = Mutex::new(());
        let alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let mut app = App::new();
        let plugins = DefaultPlugins
            .set(WindowPlugin {
                primary_window: None,
                exit_condition: ExitCondition::DontExit,
                ..default()
            })
            .set(RenderPlugin {
                synchronous_pipeline_compilation: true,
                render_creation: WgpuSettings {
                    // Mesa 22's software Vulkan crashes where Bevy's atmosphere blends with two sources.
                    disabled_features: Some(WgpuFeatures::DUAL_SOURCE_BLENDING),
                    ..default()
                }
                .into(),
                ..default()
            })
            .set(AssetPlugin {
                file_path: assets.to_string(),
                watch_for_changes_override: Some(true),
                ..default()
            })
            .disable::<WinitPlugin>()
            .disable::<LogPlugin>()
            .disable::<PipelinedRenderingPlugin>();
        app.add_plugins((plugins, WelkinPlugin));
        more(&mut app);
        // Time stands still: a picture is of second 0.
        app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::ZERO));
        while app.plugins_state() == PluginsState::Adding {
            bevy::tasks::tick_global_task_pools_on_main_thread();
        }
        app.finish();
        app.cleanup();
        Stage { app, _alone: alone }
    }

    /// The default pack as an asset.
    pub fn pack(&mut self) -> Handle<WelkinPack> {
        let pack = WelkinPack::new(pack().clone()).expect("the pack has a sky");
        self.add(pack)
    }

    /// The sky of every camera that has none of its own.
    pub fn set(&mut self, sky: WelkinSky) {
        self.app.insert_resource(GlobalWelkinSky(sky));
    }

    pub fn add<A: Asset>(&mut self, asset: A) -> Handle<A> {
        let world = self.app.world_mut();
        world.resource_mut::<Assets<A>>().add(asset)
    }

    pub fn target(&mut self, size: UVec2, format: TextureFormat) -> Handle<Image> {
        let mut image = Image::new_target_texture(size.x, size.y, format, None);
        image.texture_descriptor.usage |= TextureUsages::COPY_SRC;
        self.add(image)
    }

    /// A camera that sees a sky as linear radiance, and what it draws into.
    pub fn camera(
        &mut self,
        pack: &Handle<WelkinPack>,
        transform: Transform,
    ) -> (Entity, Handle<Image>) {
        let image = self.target(SIZE, TextureFormat::Rgba16Float);
        let camera = (
            self.lens(&image, transform),
            Hdr,
            Msaa::Off,
            WelkinView(pack.clone()),
        );
        (self.app.world_mut().spawn(camera).id(), image)
    }

    /// A camera into an image, that shows light as it is.
    pub fn lens(&self, image: &Handle<Image>, transform: Transform) -> impl Bundle {
        (
            Camera3d::default(),
            RenderTarget::Image(image.clone().into()),
            Tonemapping::None,
            DebandDither::Disabled,
            DAYLIGHT,
            transform,
        )
    }

    pub fn update(&mut self, frames: usize) {
        for _ in 0..frames {
            self.app.update();
        }
    }

    /// Draws a few frames, so that all is compiled and loaded, and reads an image.
    pub fn shoot(&mut self, image: &Handle<Image>) -> Picture {
        self.update(3);
        let read = Readback::texture(image.clone());
        let world = self.app.world_mut();
        let shot = world
            .spawn((read, Shot::default()))
            .observe(|done: On<ReadbackComplete>, mut shots: Query<&mut Shot>| {
                if let Ok(mut shot) = shots.get_mut(done.entity) {
                    shot.0 = done.data.to_vec();
                }
            })
            .id();
        for _ in 0..200 {
            self.app.update();
            let bytes = &self.app.world().get::<Shot>(shot).expect("it stays").0;
            if !bytes.is_empty() {
                let bytes = bytes.clone();
                self.app.world_mut().despawn(shot);
                return self.decoded(image, bytes);
            }
        }
        panic!("no picture was read back");
    }

    fn decoded(&self, image: &Handle<Image>, bytes: Vec<u8>) -> Picture {
        let images = self.app.world().resource::<Assets<Image>>();
        let image = images.get(image).expect("the target is there");
        let size = image.size();
        let pixels = match image.texture_descriptor.format {
            TextureFormat::Rgba16Float => bytes
                .chunks_exact(8)
                .map(|texel| {
                    let half = |i| half::f16::from_le_bytes([texel[i], texel[i + 1]]).to_f32();
                    Vec3::new(half(0), half(2), half(4))
                })
                .collect(),
            _ => bytes
                .chunks_exact(4)
                .map(|texel| {
                    let colour = Color::srgb_u8(texel[0], texel[1], texel[2]).to_linear();
                    Vec3::new(colour.red, colour.green, colour.blue)
                })
                .collect(),
        };
        Picture {
            size,
            pixels,
            bytes,
        }
    }
}

impl Picture {
    pub fn at(&self, x: u32, y: u32) -> Vec3 {
        self.pixels[(y * self.size.x + x) as usize]
    }

    /// Mean over a square of nine by nine about a place, as shares of the sides.
    pub fn about(&self, x: f32, y: f32) -> Vec3 {
        let middle = (Vec2::new(x, y) * self.size.as_vec2()).as_ivec2();
        let mut sum = Vec3::ZERO;
        for row in -4..=4 {
            for column in -4..=4 {
                let at =
                    (middle + IVec2::new(column, row)).clamp(IVec2::ZERO, self.size.as_ivec2() - 1);
                sum += self.at(at.x as u32, at.y as u32);
            }
        }
        sum / 81.0
    }

    pub fn mean(&self) -> Vec3 {
        self.pixels.iter().sum::<Vec3>() / self.pixels.len() as f32
    }

    /// Mean difference to another one over its mean, and the share of pixels that differ by more than a twentieth of their own.
    pub fn differs(&self, other: &Picture) -> (f32, f32) {
        assert_eq!(self.size, other.size);
        let pairs = self.pixels.iter().zip(&other.pixels);
        let apart = |(a, b): (&Vec3, &Vec3)| (*a - *b).abs().max_element();
        let sum: f32 = pairs.clone().map(apart).sum();
        let whole: f32 = other.pixels.iter().map(|p| p.max_element()).sum();
        let far = pairs
            .filter(|&(a, b)| apart((a, b)) > 0.05 * b.max_element() + 1e-4)
            .count();
        (sum / whole.max(1e-6), far as f32 / self.pixels.len() as f32)
    }
}
