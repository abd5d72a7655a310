//! The graphics adapters of a machine, and the choice among them.

use std::path::Path;

use crate::gpu_error::GpuError;
use crate::wanted::Wanted;

/// Programming interfaces that are asked first. GL's libraries look for a display, and complain where there is none.
const FIRST: wgpu::Backends = wgpu::Backends::PRIMARY;

/// The adapter that is wanted, or that the environment names, or the fastest one, for drawing without a display.
///
/// # Errors
/// [`GpuError::NoAdapter`], [`GpuError::NoSuchName`], [`GpuError::NoSuchAdapter`].
pub async fn without_display(wanted: Option<&Wanted>) -> Result<wgpu::Adapter, GpuError> {
    if wgpu::Backends::from_env().is_none() && wanted.is_none() {
        let found = choose(&instance(FIRST), None, None).await;
        match &found {
            Err(GpuError::NoAdapter) => {}
            Ok(adapter) if is_software(adapter) && may_have_a_gpu() => {}
            _ => return found,
        }
    }
    choose(&instance(wgpu::Backends::all()), None, wanted).await
}

/// Every adapter, in the order of their numbers.
pub async fn all() -> Vec<wgpu::AdapterInfo> {
    let adapters = enumerate(&instance(wgpu::Backends::all())).await;
    adapters.iter().map(wgpu::Adapter::get_info).collect()
}

/// The adapter of an instance that is wanted, or that the environment names, or the fastest one, of those that can draw to the surface.
///
/// # Errors
/// As [`without_display`].
pub async fn choose(
    instance: &wgpu::Instance,
    surface: Option<&wgpu::Surface<'_>>,
    wanted: Option<&Wanted>,
) -> Result<wgpu::Adapter, GpuError> {
    let fits = |adapter: &wgpu::Adapter| surface.is_none_or(|s| adapter.is_surface_supported(s));
    if let Some(wanted) = wanted {
        let mut adapters = enumerate(instance).await;
        let is_wanted = |(number, adapter): (usize, &wgpu::Adapter)| match wanted {
            Wanted::Number(wanted) => number == *wanted,
            // A card is there once for each interface, of which not every one may draw to the surface.
            Wanted::BusId(id) => {
                adapter.get_info().device_pci_bus_id.to_lowercase() == *id && fits(adapter)
            }
        };
        let place = adapters.iter().enumerate().position(is_wanted);
        return match place {
            Some(place) => Ok(adapters.swap_remove(place)),
            None if adapters.is_empty() => Err(GpuError::NoAdapter),
            None => Err(GpuError::NoSuchAdapter {
                wanted: wanted.clone(),
                count: adapters.len(),
            }),
        };
    }
    let Ok(name) = std::env::var("WGPU_ADAPTER_NAME") else {
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: surface,
            ..Default::default()
        };
        let adapter = instance.request_adapter(&options).await;
        return adapter.map_err(|_| GpuError::NoAdapter);
    };
    let mut adapters = enumerate(instance).await;
    adapters.retain(fits);
    let names: Vec<String> = adapters.iter().map(|a| a.get_info().name).collect();
    if names.is_empty() {
        return Err(GpuError::NoAdapter);
    }
    let matches = |found: &String| found.to_lowercase().contains(&name.to_lowercase());
    match names.iter().position(matches) {
        Some(place) => Ok(adapters.swap_remove(place)),
        None => Err(GpuError::NoSuchName {
            wanted: name,
            found: names.join(", "),
        }),
    }
}

/// An instance of these interfaces, or of those that the environment names.
fn instance(backends: wgpu::Backends) -> wgpu::Instance {
    wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::from_env().unwrap_or(backends),
        ..wgpu::InstanceDescriptor::new_without_display_handle_from_env()
    })
}

async fn enumerate(instance: &wgpu::Instance) -> Vec<wgpu::Adapter> {
    instance.enumerate_adapters(wgpu::Backends::all()).await
}

fn is_software(adapter: &wgpu::Adapter) -> bool {
    adapter.get_info().device_type == wgpu::DeviceType::Cpu
}

/// Whether there may be a GPU that Vulkan does not know and GL does. Off Linux nobody can say.
fn may_have_a_gpu() -> bool {
    !cfg!(target_os = "linux") || Path::new("/dev/dri").exists()
}
