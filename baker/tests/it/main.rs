//! Textures, fields, recipes and the program `welkin`, in one test program: it is linked once.

mod cli;
mod clouds;
mod common;
mod day;
mod determinism;
mod field;
mod forgeries;
mod layers;
mod methods;
mod night;
mod photo;
mod photo_formats;
mod photo_keys;
mod rebake;
mod recipe;
mod skybox;
mod sprite_pictures;
mod sprites;
mod texture_file;
