//! The body of a chat request: messages with their images, and the grammar.

use motet_decode::Grammar;
use motet_planner::model::{Message, ModelError, Role};
use motet_runtime::CameraImage as Picture;
use serde_json::{Map, Value};

use crate::dialect::{ChatBody, Delivery, Turn, TurnImage, TurnRole, request_constraint};
use crate::image::EncodedImage;
use crate::settings::ClientSettings;

/// The body of a chat that is answered piece by piece, held to a grammar where the server takes one.
pub(crate) fn chat(
    settings: &ClientSettings,
    chat: &[Message],
    constraint: Option<&Map<String, Value>>,
) -> Result<Value, ModelError> {
    let mut body = written(settings, chat, Delivery::Streamed)?;
    body.extend(constraint.into_iter().flatten().map(|(name, value)| (name.clone(), value.clone())));
    Ok(Value::Object(body))
}

/// Parameters that constrain a reply to a grammar, in the server's dialect; none for a server without a
/// dialect or without a part that carries the grammar.
pub(crate) fn constraint(
    settings: &ClientSettings,
    grammar: &Grammar,
) -> Result<Option<Map<String, Value>>, ModelError> {
    let (Some(dialect), Some(carrier)) = (settings.dialect, settings.carrier) else { return Ok(None) };
    match request_constraint(dialect, carrier, grammar) {
        Some(Value::Object(fields)) => Ok(Some(fields)),
        _ => Err(ModelError::Refused { why: "it takes no grammar of this form".to_owned() }),
    }
}

/// Messages of a chat in the protocol of the server.
fn written(
    settings: &ClientSettings,
    chat: &[Message],
    delivery: Delivery,
) -> Result<Map<String, Value>, ModelError> {
    let with_images = chat.iter().position(|message| message.role == Role::User);
    let fresh = chat.iter().map(|message| message.images.iter().map(|image| encoded(image)).collect());
    let fresh = fresh.collect::<Result<Vec<Vec<_>>, _>>()?;
    let images: Vec<Vec<TurnImage<'_>>> = fresh
        .iter()
        .enumerate()
        .map(|(index, fresh)| {
            let fixed = if Some(index) == with_images { settings.images.as_slice() } else { &[] };
            fixed.iter().chain(fresh).map(EncodedImage::of_turn).collect()
        })
        .collect();
    let turns: Vec<Turn<'_>> =
        chat.iter().zip(&images).map(|(message, images)| turn(message, images)).collect();
    let body = ChatBody { dialect: settings.dialect, model: &settings.model, turns: &turns };
    Ok(body.write(delivery))
}

fn turn<'t>(message: &'t Message, images: &'t [TurnImage<'t>]) -> Turn<'t> {
    let role = match message.role {
        Role::System => TurnRole::System,
        Role::User => TurnRole::User,
        Role::Assistant => TurnRole::Assistant,
    };
    Turn { role, text: &message.text, images }
}

fn encoded(image: &Picture) -> Result<EncodedImage, ModelError> {
    EncodedImage::new(&image.bytes).map_err(|why| ModelError::Refused {
        why: format!("the picture of the camera `{}` cannot be sent: {why}", image.camera),
    })
}

/// The body of a question about a picture, which is answered all at once.
pub(crate) fn question(
    settings: &ClientSettings,
    image: &Picture,
    question: &str,
) -> Result<Value, ModelError> {
    let image = encoded(image)?;
    let images = [image.of_turn()];
    let turns = [Turn { role: TurnRole::User, text: question, images: &images }];
    let body = ChatBody { dialect: settings.dialect, model: &settings.model, turns: &turns };
    let mut body = body.write(Delivery::Whole);
    if settings.dialect.is_none() {
        // Some servers stream unless they are told not to.
        body.insert("stream".to_owned(), false.into());
    }
    Ok(Value::Object(body))
}
