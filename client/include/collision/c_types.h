/** @file
 * The values of the interface in C (collision/collision.h, which says how to use them).
 */
#ifndef COLLISION_C_TYPES_H_
#define COLLISION_C_TYPES_H_

#include <stddef.h>
#include <stdint.h>

#include "collision/c_status.h"
#include "collision/c_values.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Shapes ---- */

/** An immutable shape. */
typedef struct collision_shape collision_shape;

/** Kinds of solids. */
enum {
  COLLISION_BALL = 0,      /**< rounding_m: its radius. */
  COLLISION_CAPSULE = 1,   /**< Along z; half_extents_m[2]: half of its length without the caps. */
  COLLISION_BOX = 2,       /**< half_extents_m */
  COLLISION_ELLIPSOID = 3, /**< half_extents_m: its half axes. */
  COLLISION_HULL = 4,      /**< Of `points`. */
  COLLISION_CYLINDER = 5,  /**< About z; half_extents_m: radius, radius, half of its length. */
  COLLISION_CONE = 6       /**< Likewise; its apex at +z. */
};

/** A convex solid in the body frame: all within rounding_m of its core. Kinds that a member means
 * nothing to want 0 there. */
typedef struct collision_solid {
  int32_t kind; /**< COLLISION_BALL ... */
  double half_extents_m[3];
  double rounding_m;
  const double* points_m; /**< Of a hull: x, y, z of each. */
  size_t points;
  double position_m[3];
  double orientation[4]; /**< w, x, y, z; four zeros: not turned. */
} collision_solid;

/* ---- Worlds and agents ---- */

/** The connection of one simulator. */
typedef struct collision_world collision_world;

/** What a shape is made of: triangles, solids, or both. Limits as in collision/shape.h. */
typedef struct collision_geometry {
  uint32_t struct_size;
  const double* vertices_m; /**< x, y, z of each. */
  size_t vertices;
  const uint32_t* indices; /**< Three of each triangle: anticlockwise, seen from outside. */
  size_t triangles;
  const collision_solid* solids;
  size_t solids_count;
} collision_geometry;

/** How a simulator connects to its world. */
typedef struct collision_world_options {
  uint32_t struct_size;
  uint32_t domain;       /**< UINT32_MAX, as initialized: COLLISION_DOMAIN, or 0. */
  const char* world;     /**< NULL: COLLISION_WORLD, or "default". */
  const char* simulator; /**< Required. */
  const char* frame;
  uint32_t run;
  uint32_t incarnation;
  uint32_t chunk_size;
  int32_t lock_step;    /**< 1, as initialized; 0: real time. */
  int32_t on_demand;    /**< 1, as initialized; 0: every state is sent. */
  int32_t leave_agents; /**< 1: they stay with the service when the world is closed. */
  int32_t tell_notices; /**< 1: notices come as news; 0: they go to standard error. */
  int64_t lead_ns;
  const char* const* levels;
  size_t levels_count;
  int64_t (*wall_clock)(void* user); /**< NULL: the system's. */
  void* wall_clock_user;
  const char* credentials; /**< Folder; NULL: COLLISION_CREDENTIALS, or none. One a process. */
} collision_world_options;

/** What an agent declares about itself. */
typedef struct collision_agent_description {
  uint32_t struct_size;
  int32_t hypothetical;
  const char* name;
  double radius_m;                        /**< NAN: the shape's. */
  double acceleration_max_m_s2;           /**< Required. */
  double angular_acceleration_max_rad_s2; /**< NAN: every orientation is possible. */
  double speed_max_m_s;                   /**< NAN: no bound. */
  double time_step_s;                     /**< NAN: continuous. */
  double jerk_max_m_s3;
  double margin_m;
  const char* class_name;
  const char* assembly;
  const char* const* meets_in_assembly;
  size_t meets_in_assembly_count;
  const char* const* never_meets;
  size_t never_meets_count;
  const collision_tag* tags;
  size_t tags_count;
  const collision_shape* shape;
  double half_space_normal[3]; /**< Three zeros: it is no half-space. */
  double half_space_offset_m;
} collision_agent_description;

/** Where an agent is and how it moves at one instant, as its owner knows it. */
typedef struct collision_state {
  uint32_t struct_size;
  int32_t discontinuity;
  int64_t stamp_ns;
  double position_m[3];
  double velocity_m_s[3];
  double acceleration_m_s2[3];
  double orientation[4]; /**< w, x, y, z */
  double angular_velocity_rad_s[3];
  double position_error_m;
  double velocity_error_m_s;
  double rotation_error_rad;
  double thrust_direction[3]; /**< Three zeros: none. */
  int64_t direction_until_ns;
  int64_t expiry_ns; /**< COLLISION_NEVER: it does not expire. */
} collision_state;

/** How long one agent is clear. */
typedef struct collision_clearance {
  uint32_t struct_size;
  int32_t not_clear;
  int32_t saturated;
  int32_t description_counts;
  int64_t clear_until_ns;
  int64_t effective_from_ns;
  int64_t void_from_ns;
  int64_t expires_ns;
  int64_t state_wanted_ns;
  const char* cause; /**< As in the IDL, "CAUSE_..."; "": none. Stays until the handle is closed. */
  collision_agent_id cause_agent;
  uint32_t lowerings;
} collision_clearance;

/** What a world has sent since it was connected. */
typedef struct collision_traffic {
  uint32_t struct_size;
  uint64_t states_set;
  uint64_t states_sent;
  uint64_t samples_sent;
  uint64_t bytes_sent;
} collision_traffic;

/** An agent of this world, for the functions below; never 0, and never used again for another. */
typedef uint64_t collision_agent;

/* ---- Events ---- */

/** The life of an event. */
enum {
  COLLISION_POSSIBLE = 0,
  COLLISION_CONFIRMED = 1,
  COLLISION_DISMISSED = 2,
  COLLISION_UNDECIDED = 3,
  COLLISION_WITHDRAWN = 4,
  COLLISION_ENDED = 5
};

/** What kept the brackets from being narrower. */
enum {
  COLLISION_LIMITED_BY_NOTHING = 0,
  COLLISION_LIMITED_BY_BUDGET = 1,
  COLLISION_LIMITED_BY_MOTION = 2,
  COLLISION_LIMITED_BY_GEOMETRY = 3
};

/** What happens if both agents keep the motion that they told. */
enum {
  COLLISION_EXPECTED_TOUCH = 0,
  COLLISION_EXPECTED_PASS = 1,
  COLLISION_EXPECTED_UNDECIDED = 2
};

/** What an agent is called. Never NULL inside: what is not known is "". */
typedef struct collision_label {
  const char* simulator;
  const char* name;
  const char* assembly;
  const collision_tag* tags;
  size_t tags_count;
} collision_label;

/** How near two agents are at one instant. */
typedef struct collision_proximity {
  int64_t at_ns;
  double separation_lower_m;
  double separation_upper_m;
  double depth_lower_m;
  double point_m[3];
  double point_error_m;
  double normal[3]; /**< From lower to higher; NAN: nobody knows it. */
  double normal_error_rad;
  double relative_velocity_m_s[3]; /**< NAN: nobody knows it. */
  double relative_velocity_error_m_s;
  int64_t lower_part; /**< -1: a ball, or not resolved. */
  int64_t higher_part;
} collision_proximity;

/** A state as its owner told it. */
typedef struct collision_state_used {
  int64_t stamp_ns;
  double position_m[3];
  double velocity_m_s[3];
  double acceleration_m_s2[3];
} collision_state_used;

/** What is certain of the least distance of two agents within a span of time. */
typedef struct collision_closest_approach {
  int64_t from_ns;
  int64_t until_ns;
  collision_bracket at;
  double distance_lower_m;
  double distance_upper_m;
} collision_closest_approach;

/** What is expected of a pair: no proof. */
typedef struct collision_expectation {
  int32_t outcome; /**< COLLISION_EXPECTED_... */
  collision_bracket begin;
  const collision_closest_approach* closest; /**< May be NULL. */
  int64_t until_ns;
} collision_expectation;

/** One revision of one contact of a pair. Every bracket contains the truth. */
typedef struct collision_event {
  uint32_t struct_size;
  int32_t status;     /**< COLLISION_POSSIBLE ... */
  int32_t limited_by; /**< COLLISION_LIMITED_BY_... */
  int32_t continuous;
  int32_t began_before;
  int32_t hypothetical;
  collision_agent_id lower;
  collision_agent_id higher;
  collision_label lower_label;
  collision_label higher_label;
  const char* level; /**< "": they touch. */
  const char* because;
  uint32_t contact;
  uint32_t revision;
  uint64_t contacts_sequence;
  int64_t now_ns;
  collision_bracket begin;
  collision_bracket end;
  double margin_m;
  const collision_proximity* proximity; /**< This and those below may be NULL. */
  const collision_state_used* lower_state;
  const collision_state_used* higher_state;
  const collision_expectation* expected;
  const collision_closest_approach* closest;
  uint64_t work_units;
  uint32_t tree_level;
  const char* sentence; /**< For people, without a newline. */
} collision_event;

/* ---- News ---- */

/** A sample that the service refused, and why. */
typedef struct collision_rejection {
  uint32_t struct_size;
  uint32_t slot;
  uint64_t simulator;
  const char* reason;
  const char* topic;
  const char* field;
  const char* detail;
  uint64_t count;
  int32_t lasting;
} collision_rejection;

/** What an agent broke of what it declared. */
typedef struct collision_breach {
  uint32_t struct_size;
  collision_agent_id agent;
  const char* field;
  double declared;
  double seen;
  int64_t from_ns;
  int64_t at_ns;
  uint64_t count;
} collision_breach;

/** The pair of agents that can intersect first. */
typedef struct collision_earliest {
  uint32_t struct_size;
  int32_t found;
  int64_t now_ns;
  int64_t earliest_ns;
  collision_agent_id lower;
  collision_agent_id higher;
} collision_earliest;

/** Everything of a simulator up to `clock_ns` has been sent. */
typedef struct collision_clock {
  uint32_t struct_size;
  int32_t lock_step;
  uint64_t simulator;
  const char* name;
  uint32_t run;
  uint32_t agents;
  int64_t clock_ns;
} collision_clock;

/** What a piece of news is, and which members of it are set. */
enum {
  COLLISION_NEWS_EVENT = 1,        /**< event */
  COLLISION_NEWS_LOWERED = 2,      /**< agent, clearance: lower than it was */
  COLLISION_NEWS_VOID = 3,         /**< agent, clearance: earlier promises do not hold */
  COLLISION_NEWS_SERVICE_LOST = 4, /**< nothing was heard of it for 2 s */
  COLLISION_NEWS_SERVICE_BACK = 5,
  COLLISION_NEWS_WAITING = 6,      /**< text: for whom time waits, with commas; "": for nobody */
  COLLISION_NEWS_NOTICE = 7,       /**< text, over, notice; monitors: of their credentials */
  COLLISION_NEWS_REJECTION = 8,    /**< rejection */
  COLLISION_NEWS_BREACH = 9,       /**< breach; this and those below come to monitors only */
  COLLISION_NEWS_STATUS = 10,      /**< status */
  COLLISION_NEWS_EARLIEST = 11,    /**< earliest */
  COLLISION_NEWS_CLEARANCE = 12,   /**< agent, clearance */
  COLLISION_NEWS_DESCRIPTION = 13, /**< agent, description, text: name of its simulator */
  COLLISION_NEWS_REMOVAL = 14,     /**< agent: its simulator and slot */
  COLLISION_NEWS_STATE = 15,       /**< agent, state */
  COLLISION_NEWS_CLOCK = 16        /**< clock */
};

/** What stands in the way of a program. */
enum {
  COLLISION_NOTICE_NO_SERVICE = 1,  /**< no service of the world is heard, since 3 s */
  COLLISION_NOTICE_WRONG_CLOCK = 2, /**< one of them is in lock-step, the other in real time */
  COLLISION_NOTICE_WAITING = 3,     /**< lock-step: a step is not granted, since 3 s */
  COLLISION_NOTICE_REFUSED = 4,     /**< the service refuses what was sent */
  COLLISION_NOTICE_NAME_TAKEN = 5,  /**< another living program has the simulator's name */
  COLLISION_NOTICE_ENDED = 6,       /**< an operator has ended the run */
  COLLISION_NOTICE_BREACH = 7,      /**< the simulator broke what it declared */
  COLLISION_NOTICE_CREDENTIALS = 8  /**< its credentials end before long, or have ended */
};

/** One piece of news. */
typedef struct collision_news {
  uint32_t struct_size;
  int32_t kind; /**< COLLISION_NEWS_...; of one that it does not know a program takes no notice. */
  collision_agent_id agent;
  const collision_event* event;
  const collision_clearance* clearance;
  const collision_rejection* rejection;
  const collision_breach* breach;
  const collision_service_status* status;
  const collision_earliest* earliest;
  const collision_agent_description* description;
  const collision_state* state;
  const collision_clock* clock;
  const char* text;
  int32_t over;   /**< What was told before is the case no longer. */
  int32_t notice; /**< COLLISION_NOTICE_... */
} collision_news;

/* ---- Monitors ---- */

/** A read-only view of a world. */
typedef struct collision_monitor collision_monitor;

/** Which world a monitor reads. */
typedef struct collision_monitor_options {
  uint32_t struct_size;
  uint32_t domain; /**< As of a world. */
  const char* world;
  int32_t service;    /**< 1, as initialized: what the service publishes. */
  int32_t simulators; /**< 1: descriptions, removals, states and clocks of all simulators, too. */
  const char* credentials; /**< As of a world. */
} collision_monitor_options;

#ifdef __cplusplus
}
#endif

#endif
