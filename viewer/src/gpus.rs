//! `welkin-view gpus`: what can be drawn with.

use std::fmt::Write;

use anyhow::Result;
use welkin_viewer::adapters;
use welkin_viewer::gpu::GpuError;

use crate::told::print;

pub fn run() -> Result<()> {
    let found = pollster::block_on(adapters::all());
    if found.is_empty() {
        return Err(GpuError::NoAdapter.into());
    }
    let mut text = String::from("--gpu  bus id        kind        name\n");
    for (number, gpu) in found.iter().enumerate() {
        let bus_id = match gpu.device_pci_bus_id.as_str() {
            "" => "-",
            id => id,
        };
        let kind = match gpu.device_type {
            wgpu::DeviceType::DiscreteGpu => "discrete",
            wgpu::DeviceType::IntegratedGpu => "integrated",
            wgpu::DeviceType::VirtualGpu => "virtual",
            wgpu::DeviceType::Cpu => "software",
            wgpu::DeviceType::Other => "other",
        };
        let name = format!("{} ({}, {})", gpu.name, gpu.backend, gpu.driver_info);
        writeln!(text, "{number:<6} {bus_id:<13} {kind:<11} {name}")?;
    }
    print(&text)
}
