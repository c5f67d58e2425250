/* Writes policies with random logits: what a model without any sense writes under the masks.
 *
 *     cc -Iruntime/decode/c/include runtime/decode/c/examples/random.c -Ltarget/release -lmotetdecode -o random
 *     LD_LIBRARY_PATH=target/release ./random 5
 *
 * prints five policies, one a line. */

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "motet.h"

/* Tokens of more than one byte; behind the 256 single bytes, and before the end of the sequence. */
static const char *const WORDS[] = {"{\"", "\":\"", "\",\"", "\"},{\"", "\"}]", "do\":\"", "end\":\"done\"}",
                                    "go\"", "pick", "user", "kitchen", "mug_1", "null", "$"};
enum { WORD_COUNT = sizeof WORDS / sizeof *WORDS, END = 256 + WORD_COUNT, COUNT = END + 1 };

static uint64_t state;

/* splitmix64, as a number in (0, 1). */
static double uniform(void) {
    uint64_t z = (state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return ((double)((z ^ (z >> 31)) >> 11) + 0.5) / 9007199254740992.0;
}

/* A normal deviate: the logit of a model with random weights. */
static double logit(void) { return sqrt(-2.0 * log(uniform())) * cos(6.283185307179586 * uniform()); }

static int fail(const char *what) {
    const char *why = motet_last_error();
    fprintf(stderr, "%s: %s\n", what, why ? why : "no reason is known");
    return 1;
}

static MotetVocabulary *vocabulary(void) {
    uint8_t bytes[256];
    MotetBytes tokens[COUNT];
    for (int byte = 0; byte < 256; byte++) {
        bytes[byte] = (uint8_t)byte;
        tokens[byte] = (MotetBytes){&bytes[byte], 1};
    }
    for (int word = 0; word < WORD_COUNT; word++)
        tokens[256 + word] = (MotetBytes){(const uint8_t *)WORDS[word], strlen(WORDS[word])};
    tokens[END] = (MotetBytes){NULL, 0};
    return motet_vocabulary_new(tokens, COUNT, END);
}

/* Writes one policy; the token is the one with the greatest logit of those that may follow. */
static int write_policy(MotetDecoder *decoder) {
    uint32_t mask[(COUNT + 31) / 32];
    for (;;) {
        if (motet_decoder_mask(decoder, mask, sizeof mask / sizeof *mask) != MOTET_STATUS_OK)
            return fail("mask");
        int best = -1;
        double most = 0.0;
        for (int token = 0; token < COUNT; token++) {
            double score = logit();
            if ((mask[token / 32] >> (token % 32) & 1) && (best < 0 || score > most)) {
                best = token;
                most = score;
            }
        }
        if (best < 0)
            return fail("no token may follow");
        if (motet_decoder_accept(decoder, (uint32_t)best) != MOTET_STATUS_OK)
            return fail("a token of the mask was refused");
        if (best == END)
            break;
    }
    char *text = motet_decoder_text(decoder);
    if (!text)
        return fail("text");
    puts(text);
    motet_string_free(text);
    return 0;
}

int main(int argc, char **argv) {
    int policies = argc > 1 ? atoi(argv[1]) : 1;
    MotetEnvironmentTexts texts = {0};
    texts.robot = "hsr";
    texts.scene = "kitchen";
    MotetEnvironment *environment = motet_environment_new(&texts);
    if (!environment)
        return fail("environment");
    MotetVocabulary *tokens = vocabulary();
    if (!tokens)
        return fail("vocabulary");
    int failed = 0;
    for (int policy = 0; policy < policies && !failed; policy++) {
        state = (uint64_t)policy;
        MotetDecoder *decoder = motet_decoder_new(environment, tokens, 600);
        failed = decoder ? write_policy(decoder) : fail("decoder");
        motet_decoder_free(decoder);
    }
    motet_vocabulary_free(tokens);
    motet_environment_free(environment);
    return failed;
}
