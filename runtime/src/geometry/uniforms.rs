//! Uniforms, declared once: a struct in Rust and the same struct in WGSL.
//!
//! Both lay members out in the order in which they are declared. Rust leaves no gap between them; WGSL aligns a `vec2f` to 8
//! bytes, a `vec3f` or a `vec4f` to 16, and a scalar fills what a `vec3f` leaves of its 16. A declaration for which they would differ does
//! not compile: exchange members, or fill a gap by one named `_pad`.

use std::fmt::Write;

use glam::{UVec2, Vec2, Vec3, Vec4};

/// A struct as WGSL has it.
#[derive(Clone, Copy, Debug)]
pub struct Struct {
    /// Its name in both languages.
    pub name: &'static str,
    /// Bytes in Rust.
    pub size: usize,
    /// Its members in their order.
    pub members: &'static [Member],
}

/// A member of a [`Struct`].
#[derive(Clone, Copy, Debug)]
pub struct Member {
    /// Its name in both languages.
    pub name: &'static str,
    /// Where it begins in Rust, in bytes.
    pub offset: usize,
    ty: &'static str,
    /// Elements of an array, 0 for what is none.
    count: usize,
}

/// A type that has the same bytes in WGSL's uniform address space, wherever it is aligned.
pub trait Uniform: Sized {
    /// What WGSL calls it, or its elements.
    const NAME: &'static str;
    /// Its alignment in WGSL, in bytes.
    const ALIGN: usize;
    /// Elements of an array, 0 for what is none.
    const COUNT: usize = 0;
}

impl Struct {
    /// Appends its WGSL.
    pub fn write(&self, text: &mut String) {
        let _ = writeln!(text, "struct {} {{", self.name);
        for &Member {
            name, ty, count, ..
        } in self.members
        {
            let _ = match count {
                0 => writeln!(text, "    {name}: {ty},"),
                _ => writeln!(text, "    {name}: array<{ty}, {count}>,"),
            };
        }
        text.push_str("}\n");
    }
}

impl Member {
    /// A member of this type.
    pub const fn new<T: Uniform>(name: &'static str, offset: usize) -> Member {
        assert!(
            offset.is_multiple_of(T::ALIGN),
            "WGSL would leave a gap before it"
        );
        Member {
            name,
            offset,
            ty: T::NAME,
            count: T::COUNT,
        }
    }
}

macro_rules! types {
    ($($ty:ty: $name:literal, $align:literal;)+) => {
        $(impl Uniform for $ty {
            const NAME: &'static str = $name;
            const ALIGN: usize = $align;
        })+
    };
}

types! {
    f32: "f32", 4;
    u32: "u32", 4;
    Vec2: "vec2f", 8;
    UVec2: "vec2u", 8;
    Vec3: "vec3f", 16;
    Vec4: "vec4f", 16;
}

impl<T: Uniform, const N: usize> Uniform for [T; N] {
    const NAME: &'static str = {
        assert!(size_of::<T>().is_multiple_of(16), "elements go by 16 bytes");
        T::NAME
    };
    const ALIGN: usize = 16;
    const COUNT: usize = N;
}

/// Declares structs of uniforms, each with its [`Struct`] as `WGSL`.
macro_rules! uniforms {
    ($($(#[$meta:meta])* $name:ident {
        $($(#[doc = $doc:literal])* $(#[cfg($cfg:meta)])? $member:ident: $ty:ty,)+
    })+) => {$(
        $(#[$meta])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
        pub struct $name {
            $($(#[doc = $doc])* $(#[cfg($cfg)])? pub $member: $ty,)+
        }

        impl $name {
            /// The same struct in WGSL.
            pub const WGSL: $crate::geometry::uniforms::Struct = $crate::geometry::uniforms::Struct {
                name: stringify!($name),
                size: {
                    assert!(size_of::<$name>().is_multiple_of(16), "uniforms go by 16 bytes");
                    size_of::<$name>()
                },
                members: &[$($(#[cfg($cfg)])? $crate::geometry::uniforms::Member::new::<$ty>(
                    stringify!($member),
                    std::mem::offset_of!($name, $member),
                )),+],
            };
        }

        impl $crate::geometry::uniforms::Uniform for $name {
            const NAME: &'static str = $name::WGSL.name;
            const ALIGN: usize = 16;
        }
    )+};
}

pub(crate) use uniforms;
