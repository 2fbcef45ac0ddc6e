/** @file
 * The client library in C: worlds, agents, clearances, events, monitors.
 *
 * The C++ headers beside this one say more of each value: a member here means what the member of
 * the same name means there (collision/types.h, world.h, monitor.h). Units are in the names, the
 * frame is the world's, times are nanoseconds: since the run's start in lock-step, since 1970 (UTC)
 * in real time.
 *
 * What a program fills in: call the structure's ..._init() first, with its sizeof. So a program
 * that was compiled with an older header goes on with a newer library. A double that is NAN, and a
 * pointer that is NULL, is not declared. Texts are UTF-8 and are copied.
 *
 * What the library hands out by pointer belongs to it, and stays until the next call of the same
 * function with that handle, or until the handle is closed. Its `struct_size` says how much of it
 * this library has: later versions add members at the end.
 *
 * Errors: functions that return a collision_result return COLLISION_OK or another one that is not
 * negative, or a negative one and change nothing unless they say so; collision_error() tells why.
 *
 * Threads: one handle is used by one thread at a time; different handles by any. The library calls
 * nothing of a program's but `wall_clock`.
 */
#ifndef COLLISION_COLLISION_H_
#define COLLISION_COLLISION_H_

#include "collision/c_types.h"

/* What the shared library shows. */
#if defined(__GNUC__)
#define COLLISION_C_API __attribute__((visibility("default")))
#else
#define COLLISION_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Results ---- */

/** Why the last call on this thread failed that did; "" before the first one. Never NULL. */
COLLISION_C_API const char* collision_error(void);

/** "0.1.0": of the library in use. */
COLLISION_C_API const char* collision_version(void);

/* ---- Shapes ---- */

/** Degenerate triangles are dropped. */
COLLISION_C_API collision_result collision_shape_create(const collision_geometry* geometry,
                                                        collision_shape** shape);
/** Agents keep what they use of it. NULL: nothing happens. */
COLLISION_C_API void collision_shape_destroy(collision_shape* shape);
/** Of the smallest ball about the reference point that contains it; 0 for NULL. */
COLLISION_C_API double collision_shape_radius_m(const collision_shape* shape);
/** 1: its surface bounds a solid. 0: it is open, or NULL. */
COLLISION_C_API int collision_shape_closed(const collision_shape* shape);

/* ---- Worlds and agents ---- */

/** The members that this library knows of the first `size` bytes get their defaults. NULL: nothing
 * happens. */
COLLISION_C_API void collision_geometry_init(collision_geometry* geometry, size_t size);
COLLISION_C_API void collision_world_options_init(collision_world_options* options, size_t size);
COLLISION_C_API void collision_agent_description_init(collision_agent_description* description,
                                                      size_t size);
COLLISION_C_API void collision_state_init(collision_state* state, size_t size);

COLLISION_C_API collision_result collision_world_connect(const collision_world_options* options,
                                                         collision_world** world);
/** With its agents, unless `leave_agents` was set. NULL: nothing happens. */
COLLISION_C_API void collision_world_close(collision_world* world);

COLLISION_C_API collision_result collision_world_wait_for_service(collision_world* world,
                                                                  int64_t timeout_ns);
/** Lock-step, before the first clock: what time is it? Set the states as they are then, and
 * collision_world_advance_to() it. */
COLLISION_C_API collision_result collision_world_join(collision_world* world, int64_t timeout_ns,
                                                      int64_t* now_ns);
/** Sends what is staged up to `clock_ns`, and that clock. */
COLLISION_C_API collision_result collision_world_publish(collision_world* world, int64_t clock_ns);
/** Lock-step: waits until time is granted up to there, then does the same. COLLISION_TIMEOUT: call
 * again. COLLISION_MISUSED: the run has ended (collision_world_ended_because()). */
COLLISION_C_API collision_result collision_world_advance_to(collision_world* world,
                                                            int64_t clock_ns, int64_t timeout_ns);
/** Lock-step: no step follows. */
COLLISION_C_API collision_result collision_world_finish(collision_world* world);
/** Takes in what has arrived, and waits at most so long for an arrival. */
COLLISION_C_API collision_result collision_world_poll(collision_world* world, int64_t timeout_ns);

COLLISION_C_API int64_t collision_world_clock_ns(const collision_world* world);
COLLISION_C_API int64_t collision_world_granted_until_ns(const collision_world* world);
/** 1: lock-step. 0: real time. -1: no service has said so far. */
COLLISION_C_API int collision_world_lock_step(const collision_world* world);
/** NULL: it does not wait; NULL: it has not ended. */
COLLISION_C_API const char* collision_world_waits_for_name(collision_world* world);
COLLISION_C_API const char* collision_world_ended_because(collision_world* world);
COLLISION_C_API uint64_t collision_world_contacts_missed(const collision_world* world);
/** Pieces of news that nobody took and newer ones have displaced. */
COLLISION_C_API uint64_t collision_world_news_lost(const collision_world* world);
COLLISION_C_API collision_result collision_world_traffic(const collision_world* world,
                                                         collision_traffic* traffic, size_t size);
/** What an agent is called that is this simulator's or was in an event; else "5d0c8a8b6f6f1d2e:3".
 * NULL: no memory, or no world. */
COLLISION_C_API const char* collision_world_name(collision_world* world, collision_agent_id id);

COLLISION_C_API collision_result
collision_world_add_agent(collision_world* world, const collision_agent_description* description,
                          const collision_state* state, collision_agent* agent);
COLLISION_C_API collision_result collision_world_remove_agent(collision_world* world,
                                                              collision_agent agent);
COLLISION_C_API collision_result collision_world_describe_agent(
    collision_world* world, collision_agent agent, const collision_agent_description* description);
/** Sets states[i] of agents[i], for each i in turn. All have the struct_size of the first. Those
 * before one that fails are set. */
COLLISION_C_API collision_result collision_world_set_states(collision_world* world,
                                                            const collision_agent* agents,
                                                            const collision_state* states,
                                                            size_t count);
/** The newest clearance of each; each element is `size` bytes long. */
COLLISION_C_API collision_result collision_world_clearances(collision_world* world,
                                                            const collision_agent* agents,
                                                            collision_clearance* clearances,
                                                            size_t size, size_t count);
COLLISION_C_API collision_result collision_world_agent_id(const collision_world* world,
                                                          collision_agent agent,
                                                          collision_agent_id* id);

/* ---- Events ---- */

/** "possible", "confirmed" ...; NULL: there is no such status. */
COLLISION_C_API const char* collision_status_name(int32_t status);

/* ---- News ---- */

/** The oldest piece of news that was not taken; NULL: there is none. It does not wait: what arrives
 * is taken in by collision_world_poll() and collision_world_advance_to(). At most 65536 are
 * kept. */
COLLISION_C_API const collision_news* collision_world_next(collision_world* world);

/* ---- Monitors ---- */

COLLISION_C_API void collision_monitor_options_init(collision_monitor_options* options,
                                                    size_t size);
COLLISION_C_API collision_result collision_monitor_open(const collision_monitor_options* options,
                                                        collision_monitor** monitor);
/** NULL: nothing happens. */
COLLISION_C_API void collision_monitor_close(collision_monitor* monitor);
/** Waits at most so long for an arrival, and takes in all that has arrived. */
COLLISION_C_API collision_result collision_monitor_poll(collision_monitor* monitor,
                                                        int64_t timeout_ns);
/** As collision_world_next(). */
COLLISION_C_API const collision_news* collision_monitor_next(collision_monitor* monitor);
COLLISION_C_API uint64_t collision_monitor_news_lost(const collision_monitor* monitor);
COLLISION_C_API uint64_t collision_monitor_contacts_missed(const collision_monitor* monitor);
/** 1: a service of this world is alive. */
COLLISION_C_API int collision_monitor_service_alive(const collision_monitor* monitor);

#ifdef __cplusplus
}
#endif

#endif
