/** @file
 * Results and small values of the interface in C (collision/collision.h).
 */
#ifndef COLLISION_C_VALUES_H_
#define COLLISION_C_VALUES_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Results ---- */

/** One of the values below. */
typedef int collision_result;

/** What a function returns. */
enum {
  COLLISION_OK = 0,
  COLLISION_TIMEOUT = 1,  /**< Not within the time given; the call can be repeated. */
  COLLISION_INVALID = -1, /**< An argument: the text names it, its value and the range. */
  COLLISION_MISUSED = -2, /**< Not in this order, or not any more. */
  COLLISION_UNAVAILABLE =
      -3,              /**< DDS is not there, or an option of the connection is out of range. */
  COLLISION_FULL = -4, /**< A limit is reached: the text names it. */
  COLLISION_NO_MEMORY = -5,
  COLLISION_FAILED = -6 /**< A defect of the library. */
};

/* ---- Values ---- */

#define COLLISION_NEVER INT64_MAX  /* A time that does not come. */
#define COLLISION_ALWAYS INT64_MIN /* No time yet. */

/** Names one agent in all runs of all simulators of a world. */
typedef struct collision_agent_id {
  uint64_t simulator; /**< Hash of the simulator's name. */
  uint32_t run;
  uint32_t slot;
  uint32_t generation;
} collision_agent_id;

/** A word about an agent. */
typedef struct collision_tag {
  const char* key;
  const char* value;
} collision_tag;

/** A closed interval of time that contains a begin or an end. */
typedef struct collision_bracket {
  int64_t earliest_ns;
  int64_t latest_ns; /**< COLLISION_NEVER: open. */
} collision_bracket;

#ifdef __cplusplus
}
#endif

#endif
