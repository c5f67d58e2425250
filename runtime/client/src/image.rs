//! Images, as chats carry them.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use thiserror::Error;

use crate::dialect::TurnImage;

/// The largest image that is sent, in bytes: servers take no larger ones.
pub const MAX_IMAGE_BYTES: usize = 16 << 20;

/// An image, encoded once.
///
/// ```
/// use motet_client::{EncodedImage, ImageError};
///
/// assert!(EncodedImage::new(b"\x89PNG and more").is_ok());
/// assert_eq!(EncodedImage::new(b"plain text"), Err(ImageError::Unknown));
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct EncodedImage {
    kind: &'static str,
    base64: String,
}

/// Error of [`EncodedImage::new`].
#[derive(Error, Clone, PartialEq, Eq, Debug)]
pub enum ImageError {
    /// Its first bytes are not those of an image.
    #[error("it is no PNG, JPEG, WebP or GIF")]
    Unknown,
    /// It is too large.
    #[error("it has {0} bytes, at most {MAX_IMAGE_BYTES} are sent")]
    TooLarge(usize),
}

impl EncodedImage {
    /// Encodes the bytes of a file. O(bytes).
    ///
    /// # Errors
    ///
    /// It is no image, or too large.
    pub fn new(bytes: &[u8]) -> Result<Self, ImageError> {
        if bytes.len() > MAX_IMAGE_BYTES {
            return Err(ImageError::TooLarge(bytes.len()));
        }
        let kind = match bytes {
            [0x89, b'P', b'N', b'G', ..] => "image/png",
            [0xff, 0xd8, 0xff, ..] => "image/jpeg",
            [b'G', b'I', b'F', b'8', ..] => "image/gif",
            [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => "image/webp",
            _ => return Err(ImageError::Unknown),
        };
        Ok(Self { kind, base64: STANDARD.encode(bytes) })
    }

    pub(crate) fn of_turn(&self) -> TurnImage<'_> {
        TurnImage { media_type: self.kind, base64: &self.base64 }
    }
}

impl std::fmt::Debug for EncodedImage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Image({}, {} characters)", self.kind, self.base64.len())
    }
}
