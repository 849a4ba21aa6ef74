/* The bytes that say what is done, and memory that ends where it says, so that a read or write behind its end is found. */
#ifndef BYTES_H
#define BYTES_H

#include <fairmesh.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const uint8_t *data;
    size_t size;
} Bytes;

/* Where they have run out, 0: that stands for what is usual everywhere. */
static inline uint8_t next(Bytes *bytes) {
    if (bytes->size == 0) return 0;
    bytes->size--;
    return *bytes->data++;
}

static inline uint32_t next_two(Bytes *bytes) {
    uint32_t low = next(bytes);
    return low + 256u * next(bytes);
}

/* Blocks that live as long as a run, or as the reading of a result. */
enum { BLOCKS = 4096 };
static void *blocks[BLOCKS];
static size_t block_count;

static inline void *block(size_t size) {
    void *made = block_count < BLOCKS ? malloc(size ? size : 1) : NULL;
    if (!made) abort();
    blocks[block_count++] = made;
    return made;
}

/* Those that were made since there were so many. */
static inline void free_blocks(size_t before) {
    while (block_count > before) free(blocks[--block_count]);
}

/* No struct that is larger is read or written: the library refuses what claims to be more than twice its size. */
enum { LARGEST_STRUCT = 4096 };

/* A struct that has as many bytes as it claims. What is behind those that are known here is `padding`. */
static inline void *sized(const void *given, size_t known, uint8_t padding) {
    uint32_t claimed;
    size_t size;
    uint8_t *made;
    memcpy(&claimed, given, 4);
    size = claimed < 4 ? 4 : claimed > LARGEST_STRUCT ? LARGEST_STRUCT : claimed;
    made = block(size);
    memset(made, padding, size);
    memcpy(made, given, size < known ? size : known);
    return made;
}

/* Room for a struct that is written, of so many words more than this header has it. */
static inline void *room_of(size_t known, int growth) {
    int64_t size = (int64_t)known + 8 * growth;
    uint32_t claimed = size < 4 ? 4 : size > LARGEST_STRUCT ? LARGEST_STRUCT : (uint32_t)size;
    uint8_t *made = block(claimed);
    memset(made, 0xa5, claimed);
    memcpy(made, &claimed, 4);
    return made;
}

#endif
