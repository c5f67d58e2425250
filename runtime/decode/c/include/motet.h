/* What a language model may write next: masks for samplers in C and C++.
 * Made by cbindgen from the crate motet-decode-c; do not edit. */

#ifndef MOTET_H
#define MOTET_H

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

// Says that the end of a sequence is the token that is known to be, by its name.
#define MOTET_END_KNOWN -1

// What a function came to.
typedef enum MotetStatus {
  // Done, or yes.
  MOTET_STATUS_OK = 0,
  // Not allowed, or no: nothing has changed.
  MOTET_STATUS_REFUSED = 1,
  // Failed: see `motet_last_error`.
  MOTET_STATUS_ERROR = 2,
} MotetStatus;

// What may follow in one policy. It is not there any more after a fault in the library itself.
typedef struct MotetDecoder MotetDecoder;

// The tokens of a language model.
typedef struct MotetVocabulary MotetVocabulary;

// A world that is prepared.
typedef struct MotetWorld MotetWorld;

// What a policy is written for. Each string is UTF-8 that ends with a null byte; null is not given. A
// world without a robot offers all primitives of the standard library. Motions are left to the run.
typedef struct MotetWorldTexts {
  // The name of a robot that is built in, or the text of a `robot.toml`.
  const char *robot;
  // The text of the `primitives.motet` beside it.
  const char *declarations;
  // The name of a scene that is built in, or the text of one in JSON.
  const char *scene;
  // What is known at the start, in JSON: `{"holding(mug_1)": true}`.
  const char *state;
  // Further declarations, as text.
  const char *domain;
  // Whether deadlines and retries have a place; `null` in it is the default.
  bool modifiers;
  // Whether policies are written in the text form; false is JSON.
  bool text;
} MotetWorldTexts;

// Bytes; not ended by a null byte.
typedef struct MotetBytes {
  // The first; may be null where there are none.
  const uint8_t *data;
  // How many.
  uintptr_t len;
} MotetBytes;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Why the last function that was called by this thread failed, in words; null where it did not fail. Valid
// until the thread calls the next function of this library.
const char *motet_last_error(void);

// Frees a string that a function of this library returned; null is nothing.
//
// # Safety
//
// `string` is null, or came from this library and was not freed yet.
void motet_string_free(char *string);

// Opens and prepares a world. Null on an error.
//
// # Safety
//
// `texts` is null or points to strings as [`MotetWorldTexts`] says.
struct MotetWorld *motet_world_new(const struct MotetWorldTexts *texts);

// Frees a world; null is nothing. Decoders that were made of it go on.
//
// # Safety
//
// `world` is null or a live world, which is not used again.
void motet_world_free(struct MotetWorld *world);

// What the checker says of a whole policy in either form: JSON objects, one a line, none where nothing is
// to be said. Freed with [`motet_string_free`](crate::motet_string_free). Null on an error.
//
// # Safety
//
// `world` is null or a live world; `policy` is null or points to `len` bytes.
char *motet_world_check(const struct MotetWorld *world, const uint8_t *policy, uintptr_t len);

// A vocabulary of so many tokens in the order of their numbers; one without bytes is special, and never
// allowed. `end` is the token that ends a sequence. Null on an error.
//
// # Safety
//
// `tokens` is null or points to `count` values, and each of them to as many bytes as it says.
struct MotetVocabulary *motet_vocabulary_new(const struct MotetBytes *tokens, uintptr_t count, uint32_t end);

// A vocabulary from a file: `tokenizer.json` of Hugging Face, a list in JSON, or lines in base64 such as
// tiktoken's ranks. `end` is the token that ends a sequence, or [`MOTET_END_KNOWN`]. Null on an error.
//
// # Safety
//
// `file` is null or points to `len` bytes.
struct MotetVocabulary *motet_vocabulary_read(const uint8_t *file, uintptr_t len, int64_t end);

// How many 32-bit words a mask has. 0 on an error.
//
// # Safety
//
// `vocabulary` is null or a live vocabulary.
uintptr_t motet_vocabulary_mask_words(const struct MotetVocabulary *vocabulary);

// Frees a vocabulary; null is nothing. Decoders that were made of it go on.
//
// # Safety
//
// `vocabulary` is null or a live vocabulary, which is not used again.
void motet_vocabulary_free(struct MotetVocabulary *vocabulary);

// A decoder of a policy of at most `budget` bytes. Null on an error, such as a budget that no policy fits.
//
// # Safety
//
// `world` and `vocabulary` are null or live.
struct MotetDecoder *motet_decoder_new(const struct MotetWorld *world,
                                       const struct MotetVocabulary *vocabulary,
                                       uintptr_t budget);

// Another decoder in the same state. Null on an error.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
struct MotetDecoder *motet_decoder_clone(struct MotetDecoder *decoder);

// Frees a decoder; null is nothing.
//
// # Safety
//
// `decoder` is null or live, and is not used again.
void motet_decoder_free(struct MotetDecoder *decoder);

// Writes which tokens may follow: token `t` where bit `t % 32` of word `t / 32` is set. Takes as many
// words as `motet_vocabulary_mask_words` says, or more, of which the rest becomes 0.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile; `words` is null or has room for `count`
// words.
enum MotetStatus motet_decoder_mask(struct MotetDecoder *decoder, uint32_t *words, uintptr_t count);

// Takes a token, if it may follow.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
enum MotetStatus motet_decoder_accept(struct MotetDecoder *decoder, uint32_t token);

// Takes back the last tokens; all of them where there are not so many.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
enum MotetStatus motet_decoder_rollback(struct MotetDecoder *decoder, uintptr_t tokens);

// Whether what was written so far is a whole policy: then, and only then, the end of the sequence may
// follow.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
enum MotetStatus motet_decoder_is_accepting(struct MotetDecoder *decoder);

// The text that must come next, whatever is meant; empty where there is a choice. Freed with
// `motet_string_free`. Null on an error.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
char *motet_decoder_forced(struct MotetDecoder *decoder);

// The text so far. Freed with `motet_string_free`. Null on an error.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
char *motet_decoder_text(struct MotetDecoder *decoder);

// What the checker says of bytes that may not follow: JSON objects, one a line; none where they may
// follow, or where it is only their spelling that is refused. Freed with `motet_string_free`. Null on an
// error.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile; `bytes` is null or points to `len` bytes.
char *motet_decoder_why_not(struct MotetDecoder *decoder, const uint8_t *bytes, uintptr_t len);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* MOTET_H */
