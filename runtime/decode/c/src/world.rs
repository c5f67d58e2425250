//! Worlds: a robot, a room and what else is known, prepared for any number of policies.

use std::ffi::c_char;

use motet_decode::{AcceptorFactory, Environment, Modifiers, Subset};
use motet_syntax::{FileId, Source, Sources, Syntax, render};

use crate::border::{free, guarded, handle, shared, slice, string, string_out};

/// What a policy is written for. Each string is UTF-8 that ends with a null byte; null is not given. A world without a
/// robot offers all primitives of the standard library. Motions are left to the run.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MotetWorldTexts {
    /// The name of a robot that is built in, or the text of a `robot.toml`.
    pub robot: *const c_char,
    /// The text of the `primitives.motet` beside it.
    pub declarations: *const c_char,
    /// The name of a scene that is built in, or the text of one in JSON.
    pub scene: *const c_char,
    /// What is known at the start, in JSON: `{"holding(mug_1)": true}`.
    pub state: *const c_char,
    /// Further declarations, as text.
    pub domain: *const c_char,
    /// Whether deadlines and retries have a place; `null` in it is the default.
    pub modifiers: bool,
    /// Whether policies are written in the text form; false is JSON.
    pub text: bool,
}

/// A world that is prepared.
pub struct MotetWorld {
    pub(crate) prepared: AcceptorFactory,
    session: motet_decode::Session,
}

/// Opens and prepares a world. Null on an error.
///
/// # Safety
///
/// `texts` is null or points to strings as [`MotetWorldTexts`] says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_world_new(texts: *const MotetWorldTexts) -> *mut MotetWorld {
    guarded(std::ptr::null_mut(), || {
        // SAFETY: as the function's.
        let texts = unsafe { shared(texts, "world")? };
        // SAFETY: as the function's.
        let text = |at, what| unsafe { string(at, what) };
        let world = Environment {
            robot: text(texts.robot, "robot")?,
            declarations: text(texts.declarations, "declarations")?,
            scene: text(texts.scene, "scene")?,
            state: text(texts.state, "state")?,
            domain: text(texts.domain, "domain")?,
        };
        let session = world.session().map_err(|error| error.to_string())?;
        let modifiers = if texts.modifiers { Modifiers::Written } else { Modifiers::Default };
        let form = if texts.text { Syntax::Text } else { Syntax::Json };
        let prepared =
            AcceptorFactory::new(&session, Subset { syntax: form, modifiers, ..Subset::default() });
        Ok(handle(MotetWorld { prepared, session }))
    })
}

/// Frees a world; null is nothing. Decoders that were made of it go on.
///
/// # Safety
///
/// `world` is null or a live world, which is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_world_free(world: *mut MotetWorld) {
    // SAFETY: as the function's.
    unsafe { free(world) };
}

/// What the checker says of a whole policy in either form: JSON objects, one a line, none where nothing is to be said.
/// Freed with [`motet_string_free`](crate::motet_string_free). Null on an error.
///
/// # Safety
///
/// `world` is null or a live world; `policy` is null or points to `len` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_world_check(
    world: *const MotetWorld,
    policy: *const u8,
    len: usize,
) -> *mut c_char {
    guarded(std::ptr::null_mut(), || {
        // SAFETY: as the function's.
        let world = unsafe { shared(world, "world")? };
        // SAFETY: as the function's.
        let policy = unsafe { slice(policy, len, "policy")? };
        let policy = std::str::from_utf8(policy).map_err(|_| "the policy is no UTF-8".to_owned())?;
        let mut sources = Sources::default();
        let source = Source::new("policy", policy);
        sources.add(source.clone());
        let parsed = motet_syntax::read(&source, FileId(0));
        Ok(string_out(render::json(&world.session.check(&parsed), &sources)))
    })
}
