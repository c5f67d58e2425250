/* Masks of the tokens that a language model may write next, for samplers in C and C++.
 * Made by cbindgen from the crate motet-decode-c; do not edit. */

#ifndef MOTET_H
#define MOTET_H

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

// The end of a sequence is the token with a well-known name.
#define MOTET_END_KNOWN -1

// The outcome of a function.
typedef enum MotetStatus {
  // Done, or yes.
  MOTET_STATUS_OK = 0,
  // Not allowed, or no: nothing has changed.
  MOTET_STATUS_REFUSED = 1,
  // Failed: see `motet_last_error`.
  MOTET_STATUS_ERROR = 2,
} MotetStatus;

// Follows one policy, token by token. After a fault in the library itself it cannot be used any more.
typedef struct MotetDecoder MotetDecoder;

// A prepared environment.
typedef struct MotetEnvironment MotetEnvironment;

// The tokens of a language model.
typedef struct MotetVocabulary MotetVocabulary;

// The texts of an environment. Each string is UTF-8 that ends with a null byte; null is a text that is not
// given. An environment without a robot offers all primitives of the standard library. Motions are left to
// the run.
typedef struct MotetEnvironmentTexts {
  // The name of a built-in robot, or the text of a `robot.toml`.
  const char *robot;
  // The text of the `primitives.motet` beside it.
  const char *declarations;
  // The name of a built-in scene, or the text of one in JSON.
  const char *scene;
  // Facts at the start, in JSON: `{"holding(mug_1)": true}`.
  const char *state;
  // Text of further declarations.
  const char *domain;
  // Deadlines and retries can be written; `null` in JSON is the default.
  bool modifiers;
  // Policies are written in the text syntax; false is JSON.
  bool text;
} MotetEnvironmentTexts;

// Bytes; not ended by a null byte.
typedef struct MotetBytes {
  // Address of the first byte; may be null if there are none.
  const uint8_t *data;
  // The number of bytes.
  uintptr_t len;
} MotetBytes;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Returns the reason why the last function that this thread called failed; null if it did not fail. Valid
// until the thread calls the next function of this library.
const char *motet_last_error(void);

// Frees a string that a function of this library returned; null does nothing.
//
// # Safety
//
// `string` is null, or came from this library and was not freed yet.
void motet_string_free(char *string);

// Opens and prepares an environment. Null on an error.
//
// # Safety
//
// `texts` is null or points to strings as [`MotetEnvironmentTexts`] says.
struct MotetEnvironment *motet_environment_new(const struct MotetEnvironmentTexts *texts);

// Frees an environment; null does nothing. Decoders of it stay valid.
//
// # Safety
//
// `environment` is null or a live environment, which is not used again.
void motet_environment_free(struct MotetEnvironment *environment);

// Checks a whole policy in either syntax: the diagnostics as JSON objects, one a line; empty without any.
// Freed with [`motet_string_free`](crate::motet_string_free). Null on an error.
//
// # Safety
//
// `environment` is null or a live environment; `policy` is null or points to `len` bytes.
char *motet_environment_check(const struct MotetEnvironment *environment,
                              const uint8_t *policy,
                              uintptr_t len);

// Creates a vocabulary of `count` tokens in the order of their numbers; one without bytes is special, and
// never allowed. `end` is the token that ends a sequence. Null on an error.
//
// # Safety
//
// `tokens` is null or points to `count` values, and each of them to as many bytes as it says.
struct MotetVocabulary *motet_vocabulary_new(const struct MotetBytes *tokens, uintptr_t count, uint32_t end);

// Reads a vocabulary from a file: `tokenizer.json` of Hugging Face, a list in JSON, or lines of base64 such
// as the ranks of tiktoken. `end` is the token that ends a sequence, or [`MOTET_END_KNOWN`]. Null on an
// error.
//
// # Safety
//
// `file` is null or points to `len` bytes.
struct MotetVocabulary *motet_vocabulary_read(const uint8_t *file, uintptr_t len, int64_t end);

// Returns the number of 32-bit words of a mask; 0 on an error.
//
// # Safety
//
// `vocabulary` is null or a live vocabulary.
uintptr_t motet_vocabulary_mask_words(const struct MotetVocabulary *vocabulary);

// Frees a vocabulary; null does nothing. Decoders of it stay valid.
//
// # Safety
//
// `vocabulary` is null or a live vocabulary, which is not used again.
void motet_vocabulary_free(struct MotetVocabulary *vocabulary);

// Creates a decoder for a policy of at most `budget` bytes. Null on an error, such as a budget that no
// policy fits.
//
// # Safety
//
// `environment` and `vocabulary` are null or live.
struct MotetDecoder *motet_decoder_new(const struct MotetEnvironment *environment,
                                       const struct MotetVocabulary *vocabulary,
                                       uintptr_t budget);

// Creates another decoder in the same state. Null on an error.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
struct MotetDecoder *motet_decoder_clone(struct MotetDecoder *decoder);

// Frees a decoder; null does nothing.
//
// # Safety
//
// `decoder` is null or live, and is not used again.
void motet_decoder_free(struct MotetDecoder *decoder);

// Writes the mask of the tokens that may follow: token `t` is bit `t % 32` of word `t / 32`. `count` is at
// least `motet_vocabulary_mask_words`; further words become 0.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile; `words` is null or has room for `count`
// words.
enum MotetStatus motet_decoder_mask(struct MotetDecoder *decoder, uint32_t *words, uintptr_t count);

// Writes the mask as `motet_decoder_mask` does, with a limit of its time: `effort` is what the checker may
// look at, and 20,000 take about half a millisecond. `Refused` if that was not enough. Then the mask has all
// tokens that may follow, and others that only names and types allow: where `motet_decoder_accept` refuses
// the chosen token, ask for the mask again, which lacks that token, and choose another one.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile; `words` is null or has room for `count`
// words.
enum MotetStatus motet_decoder_mask_within(struct MotetDecoder *decoder,
                                           uint64_t effort,
                                           uint32_t *words,
                                           uintptr_t count);

// Takes a token if it may follow.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
enum MotetStatus motet_decoder_accept(struct MotetDecoder *decoder, uint32_t token);

// Takes back the last tokens, or all if there are fewer.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
enum MotetStatus motet_decoder_rollback(struct MotetDecoder *decoder, uintptr_t tokens);

// Answers if the text so far is a whole policy: then, and only then, the end of the sequence may follow.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
enum MotetStatus motet_decoder_is_accepting(struct MotetDecoder *decoder);

// Returns the text that must come next whatever the model means; empty if there is a choice. Freed with
// `motet_string_free`. Null on an error.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
char *motet_decoder_forced(struct MotetDecoder *decoder);

// Returns the text so far. Freed with `motet_string_free`. Null on an error.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile.
char *motet_decoder_text(struct MotetDecoder *decoder);

// Explains the refusal of bytes: the errors of the checker as JSON objects, one a line; empty if the bytes
// may follow, or if only their spelling is refused. Freed with `motet_string_free`. Null on an error.
//
// # Safety
//
// `decoder` is null or live, and nobody else uses it meanwhile; `bytes` is null or points to `len` bytes.
char *motet_decoder_why_not(struct MotetDecoder *decoder, const uint8_t *bytes, uintptr_t len);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* MOTET_H */
