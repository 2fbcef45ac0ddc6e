/** @file
 * What a service tells of itself, in the interface in C (collision/collision.h).
 */
#ifndef COLLISION_C_STATUS_H_
#define COLLISION_C_STATUS_H_

#include <stddef.h>
#include <stdint.h>

#include "collision/c_values.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What a simulator has of one of the limits of the world, and may have as things are. */
typedef struct collision_quota {
  const char* name; /**< agents, shapes, shape_bytes, tree_bytes */
  uint64_t used;
  uint64_t most;
} collision_quota;

/** What the service knows of one simulator. */
typedef struct collision_simulator_status {
  uint64_t simulator;
  const char* name;
  uint32_t run;
  uint32_t agents;
  int64_t clock_ns;
  int64_t granted_until_ns;
  uint64_t states;
  uint64_t rejected;
  collision_bracket clock_offset;
  int32_t alive;
  uint32_t refused_now;          /**< Of what it has written, as it stands. */
  const char* refused_why;       /**< Of one of these: reason and field; "": none. */
  const collision_quota* quotas; /**< Those of which it has something. */
  size_t quotas_count;
} collision_simulator_status;

/** A counter of the service. */
typedef struct collision_counter {
  const char* name;
  uint64_t value;
} collision_counter;

/** How many values fell into each class since the service began. Classes end at 1, 2, 5, 10, 20,
    50, ... in the unit that ends the name. */
typedef struct collision_histogram {
  const char* name; /**< step_us, update_to_contact_us, contact_bracket_ns */
  const uint64_t* counts;
  size_t counts_count;
} collision_histogram;

/** What the service tells of itself. */
typedef struct collision_service_status {
  uint32_t struct_size;
  uint32_t term;
  uint64_t service;
  const char* version;
  const char* world;
  int32_t lock_step;
  uint32_t agents;
  uint32_t pairs_tracked;
  int64_t now_ns;
  const collision_simulator_status* simulators; /**< Each `simulator_size` bytes long. */
  size_t simulator_size;
  size_t simulators_count;
  const collision_counter* counters;
  size_t counters_count;
  const char* build;     /**< Compiler, and whether its checks are on. */
  int64_t started_ns;    /**< Wall clock, since 1970. */
  int64_t uptime_ns;     /**< Also while the machine slept. */
  uint64_t cpu_us;       /**< Of all threads of the process together. */
  uint64_t memory_bytes; /**< Resident. */
  const collision_histogram* histograms;
  size_t histograms_count;
} collision_service_status;

#ifdef __cplusplus
}
#endif

#endif
