/* A program in C that uses every function of the C interface, beside a service that a test runs:
 *
 *     c-interface PART WORLD DOMAIN
 *
 * It prints what was wrong, and ends with 1 then. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "collision/collision.h"

#define SECOND INT64_C(1000000000)
#define PATIENCE (240 * SECOND)

static int failures = 0;

#define CHECK(condition)                                                                      \
  do {                                                                                        \
    if (!(condition)) {                                                                       \
      ++failures;                                                                             \
      fprintf(stderr, "line %d: %s; last error: %s\n", __LINE__, #condition, collision_error()); \
    }                                                                                         \
  } while (0)

/* What cannot go on without it. */
#define REQUIRE(condition)     \
  do {                         \
    CHECK(condition);          \
    if (failures > 0) exit(1); \
  } while (0)

static const char* world_name = NULL;
static uint32_t domain = 0;
/* Folders, in a secured world. */
static const char *credentials = NULL, *others_credentials = NULL;

/* ---- Values ---- */

static collision_agent_description ball(const char* name, double radius_m) {
  collision_agent_description description;
  collision_agent_description_init(&description, sizeof description);
  description.name = name;
  description.radius_m = radius_m;
  description.acceleration_max_m_s2 = 1;
  return description;
}

static collision_state moving(int64_t t_ns, double x_m, double speed_m_s) {
  collision_state state;
  collision_state_init(&state, sizeof state);
  state.stamp_ns = t_ns;
  state.position_m[0] = x_m + speed_m_s * 1e-9 * (double)t_ns;
  state.velocity_m_s[0] = speed_m_s;
  return state;
}

static collision_world* connected(const char* simulator) {
  collision_world_options options;
  collision_world* world = NULL;
  collision_world_options_init(&options, sizeof options);
  options.world = world_name;
  options.domain = domain;
  options.simulator = simulator;
  options.credentials = credentials;
  options.tell_notices = 1;
  REQUIRE(collision_world_connect(&options, &world) == COLLISION_OK);
  REQUIRE(collision_world_wait_for_service(world, PATIENCE) == COLLISION_OK);
  return world;
}

static collision_monitor* opened(void) {
  collision_monitor_options options;
  collision_monitor* monitor = NULL;
  collision_monitor_options_init(&options, sizeof options);
  options.world = world_name;
  options.domain = domain;
  options.simulators = 1;
  options.credentials = credentials;
  REQUIRE(collision_monitor_open(&options, &monitor) == COLLISION_OK);
  return monitor;
}

static int says(const char* part) { return strstr(collision_error(), part) != NULL; }

/* ---- Without a service ---- */

static void check_nulls(void) {
  collision_agent agent = 1;
  collision_agent_id id;
  collision_traffic traffic;
  collision_clearance clearance;
  collision_state state = moving(0, 0, 0);
  collision_agent_description description = ball("a", 1);
  int64_t now_ns = 0;
  collision_world_options_init(NULL, 100);
  collision_monitor_options_init(NULL, 100);
  collision_agent_description_init(NULL, 100);
  collision_state_init(NULL, 100);
  CHECK(collision_world_connect(NULL, NULL) == COLLISION_INVALID && says("world: null"));
  CHECK(collision_world_wait_for_service(NULL, 0) == COLLISION_INVALID);
  CHECK(collision_world_join(NULL, 0, &now_ns) == COLLISION_INVALID);
  CHECK(collision_world_publish(NULL, 0) == COLLISION_INVALID);
  CHECK(collision_world_advance_to(NULL, 0, 0) == COLLISION_INVALID);
  CHECK(collision_world_finish(NULL) == COLLISION_INVALID);
  CHECK(collision_world_poll(NULL, 0) == COLLISION_INVALID);
  CHECK(collision_world_clock_ns(NULL) == COLLISION_ALWAYS);
  CHECK(collision_world_granted_until_ns(NULL) == COLLISION_ALWAYS);
  CHECK(collision_world_lock_step(NULL) == -1);
  CHECK(collision_world_waits_for_name(NULL) == NULL);
  CHECK(collision_world_ended_because(NULL) == NULL);
  CHECK(collision_world_contacts_missed(NULL) == 0);
  CHECK(collision_world_news_lost(NULL) == 0);
  CHECK(collision_world_traffic(NULL, &traffic, sizeof traffic) == COLLISION_INVALID);
  CHECK(collision_world_add_agent(NULL, &description, &state, &agent) == COLLISION_INVALID);
  CHECK(collision_world_remove_agent(NULL, agent) == COLLISION_INVALID);
  CHECK(collision_world_describe_agent(NULL, agent, &description) == COLLISION_INVALID);
  CHECK(collision_world_set_states(NULL, &agent, &state, 1) == COLLISION_INVALID);
  CHECK(collision_world_clearances(NULL, &agent, &clearance, sizeof clearance, 1) ==
        COLLISION_INVALID);
  CHECK(collision_world_agent_id(NULL, agent, &id) == COLLISION_INVALID);
  CHECK(collision_world_next(NULL) == NULL);
  collision_world_close(NULL);
  CHECK(collision_monitor_open(NULL, NULL) == COLLISION_INVALID);
  CHECK(collision_monitor_poll(NULL, 0) == COLLISION_INVALID && says("monitor: null"));
  CHECK(collision_monitor_next(NULL) == NULL);
  CHECK(collision_monitor_news_lost(NULL) == 0);
  CHECK(collision_monitor_contacts_missed(NULL) == 0);
  CHECK(collision_monitor_service_alive(NULL) == 0);
  collision_monitor_close(NULL);
}

static collision_result made(const double* vertices_m, size_t vertices, size_t triangles,
                             const collision_solid* solid, collision_shape** shape) {
  static const uint32_t indices[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  collision_geometry geometry;
  collision_geometry_init(&geometry, sizeof geometry);
  geometry.vertices_m = vertices_m;
  geometry.vertices = vertices;
  geometry.indices = triangles > 0 ? indices : NULL;
  geometry.triangles = triangles;
  geometry.solids = solid;
  geometry.solids_count = solid == NULL ? 0 : 1;
  return collision_shape_create(&geometry, shape);
}

static void check_shapes(void) {
  /* A tetrahedron, its outside where the corners run anticlockwise. */
  const double vertices_m[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double points_m[] = {1, 0, 0, -1, 0, 0, 0, 2, 0, 0, 0, 1};
  collision_geometry geometry;
  collision_solid solid;
  collision_shape* shape = NULL;
  collision_shape* other = NULL;
  REQUIRE(made(vertices_m, 4, 4, NULL, &shape) == COLLISION_OK);
  CHECK(collision_shape_closed(shape) == 1);
  CHECK(collision_shape_radius_m(shape) >= 1 && collision_shape_radius_m(shape) < 1.000001);
  REQUIRE(made(vertices_m, 4, 3, NULL, &other) == COLLISION_OK);
  CHECK(collision_shape_closed(other) == 0);
  collision_shape_destroy(other);
  other = NULL;

  memset(&solid, 0, sizeof solid);
  solid.kind = COLLISION_HULL;
  solid.points_m = points_m;
  solid.points = 4;
  solid.rounding_m = 0.5;
  REQUIRE(made(NULL, 0, 0, &solid, &other) == COLLISION_OK);
  CHECK(fabs(collision_shape_radius_m(other) - 2.5) < 1e-6);
  collision_shape_destroy(other);
  other = NULL;

  CHECK(made(vertices_m, 4, 4, NULL, NULL) == COLLISION_INVALID && says("shape: null"));
  CHECK(made(NULL, 4, 4, NULL, &other) == COLLISION_INVALID && says("vertices_m: null"));
  CHECK(made(NULL, 0, 0, NULL, &other) == COLLISION_INVALID);
  CHECK(collision_shape_create(NULL, &other) == COLLISION_INVALID && says("geometry: null"));
  collision_geometry_init(&geometry, sizeof geometry);
  geometry.vertices_m = vertices_m;
  geometry.vertices = SIZE_MAX;
  CHECK(collision_shape_create(&geometry, &other) == COLLISION_INVALID && says("vertices_m: 1844"));
  geometry.vertices = 4;
  geometry.indices = (const uint32_t*)vertices_m;
  geometry.triangles = SIZE_MAX / 2;
  CHECK(collision_shape_create(&geometry, &other) == COLLISION_INVALID && says("indices: "));
  geometry.triangles = 0;
  geometry.solids = &solid;
  geometry.solids_count = SIZE_MAX / 4;
  CHECK(collision_shape_create(&geometry, &other) == COLLISION_INVALID && says("solids: "));
  solid.points = SIZE_MAX;
  CHECK(made(NULL, 0, 0, &solid, &other) == COLLISION_INVALID && says("points_m: "));
  solid.points = 4;
  memset(&geometry, 0, sizeof geometry);
  CHECK(collision_shape_create(&geometry, &other) == COLLISION_INVALID && says("struct_size"));
  collision_geometry_init(NULL, 100);
  solid.kind = 99;
  CHECK(made(NULL, 0, 0, &solid, &other) == COLLISION_INVALID && says("kind: 99"));
  solid.kind = COLLISION_BOX; /* A box has no points. */
  CHECK(made(NULL, 0, 0, &solid, &other) == COLLISION_INVALID);
  CHECK(other == NULL);
  CHECK(collision_shape_radius_m(NULL) == 0 && collision_shape_closed(NULL) == 0);
  collision_shape_destroy(shape);
  collision_shape_destroy(NULL);
}

static void check_options(void) {
  collision_world_options options;
  collision_monitor_options reads;
  collision_world* world = NULL;
  collision_monitor* monitor = NULL;
  memset(&options, 0, sizeof options);
  options.simulator = "alpha";
  CHECK(collision_world_connect(&options, &world) == COLLISION_INVALID && says("struct_size"));
  collision_world_options_init(&options, sizeof options);
  CHECK(options.lock_step == 1 && options.on_demand == 1 && options.domain == UINT32_MAX);
  CHECK(collision_world_connect(&options, &world) == COLLISION_INVALID && says("simulator"));
  options.simulator = "not a name";
  CHECK(collision_world_connect(&options, &world) == COLLISION_INVALID && says("not a name"));
  options.simulator = "alpha";
  options.domain = 1000;
  CHECK(collision_world_connect(&options, &world) == COLLISION_INVALID && says("domain: 1000"));
  options.domain = domain;
  options.levels = &options.simulator;
  options.levels_count = SIZE_MAX;
  CHECK(collision_world_connect(&options, &world) == COLLISION_INVALID && says("levels: "));
  options.levels_count = 0;
  /* A size that ends within a member: nothing is read in part. */
  options.struct_size = 21;
  CHECK(collision_world_connect(&options, &world) == COLLISION_INVALID && says("simulator"));
  CHECK(world == NULL);
  collision_monitor_options_init(&reads, sizeof reads);
  CHECK(reads.service == 1 && reads.simulators == 0);
  reads.domain = 1000;
  CHECK(collision_monitor_open(&reads, &monitor) < 0 && says("domain: 1000"));
  CHECK(monitor == NULL);
}

static void part_alone(void) {
  CHECK(strcmp(collision_error(), "") == 0);
  CHECK(strchr(collision_version(), '.') != NULL);
  CHECK(strcmp(collision_status_name(COLLISION_POSSIBLE), "possible") == 0);
  CHECK(strcmp(collision_status_name(COLLISION_ENDED), "ended") == 0);
  CHECK(collision_status_name(-1) == NULL && collision_status_name(6) == NULL);
  check_nulls();
  check_shapes();
  check_options();
}

/* ---- Two balls meet, and a monitor sees it ---- */

/* How often each kind of news came, and what was in it. */
typedef struct heard {
  int kinds[32];
  int confirmed, ended, events_without_names, breached_acceleration, refused_for_room;
  collision_bracket begin;
} heard;

static void hear_event(const collision_event* event, heard* all) {
  const int is_named = strcmp(event->lower_label.simulator, "two-balls") == 0 &&
                       strcmp(event->higher_label.simulator, "two-balls") == 0;
  CHECK(event->struct_size >= sizeof *event);
  CHECK(event->lower.simulator == event->higher.simulator);
  CHECK(event->sentence != NULL && strstr(event->sentence, "ada") != NULL);
  if (!is_named || strcmp(event->level, "") != 0) ++all->events_without_names;
  if (event->lower_label.tags_count == 1) {
    CHECK(strcmp(event->lower_label.tags[0].key, "kind") == 0);
    CHECK(strcmp(event->lower_label.tags[0].value, "ball") == 0);
  }
  if (event->status == COLLISION_POSSIBLE && event->expected != NULL) {
    CHECK(event->expected->outcome == COLLISION_EXPECTED_TOUCH);
    CHECK(event->expected->closest == NULL);
  }
  if (event->status == COLLISION_CONFIRMED) {
    ++all->confirmed;
    all->begin = event->begin;
    REQUIRE(event->proximity != NULL);
    CHECK(event->proximity->separation_upper_m <= 0 && event->contacts_sequence > 0);
    CHECK(event->lower_state != NULL && event->higher_state != NULL);
  }
  if (event->status == COLLISION_ENDED) {
    ++all->ended;
    CHECK(event->closest != NULL && event->closest->distance_upper_m <= 0);
  }
}

static void hear(const collision_news* news, heard* all) {
  size_t i;
  REQUIRE(news->struct_size >= sizeof *news && news->kind > 0 && news->kind < 32);
  ++all->kinds[news->kind];
  switch (news->kind) {
    case COLLISION_NEWS_EVENT:
      hear_event(news->event, all);
      return;
    case COLLISION_NEWS_REJECTION:
      CHECK(news->rejection->count > 0 && strcmp(news->rejection->detail, "") != 0);
      if (strcmp(news->rejection->reason, "REJECTED_TOO_MANY_AGENTS") == 0) ++all->refused_for_room;
      return;
    case COLLISION_NEWS_BREACH:
      CHECK(news->breach->seen > news->breach->declared && news->breach->count > 0);
      if (strcmp(news->breach->field, "acceleration_max_m_s2") == 0) ++all->breached_acceleration;
      return;
    case COLLISION_NEWS_STATUS:
      CHECK(strcmp(news->status->world, world_name) == 0 && news->status->lock_step == 1);
      CHECK(news->status->counters_count > 10 && news->status->counters[0].name != NULL);
      CHECK(news->status->simulator_size == sizeof(collision_simulator_status));
      CHECK(strlen(news->status->build) > 0 && news->status->uptime_ns > 0);
      CHECK(news->status->memory_bytes > 1000000 && news->status->started_ns > 0);
      CHECK(news->status->histograms_count == 3 && news->status->histograms[0].name != NULL);
      for (i = 0; i < news->status->simulators_count; ++i) {
        const collision_simulator_status* one = &news->status->simulators[i];
        if (one->agents == 0) continue;
        CHECK(one->quotas_count > 0 && one->quotas[0].most >= one->quotas[0].used);
        CHECK(one->quotas[0].used > 0 && one->quotas[0].name != NULL);
      }
      return;
    case COLLISION_NEWS_CLEARANCE:
    case COLLISION_NEWS_LOWERED:
    case COLLISION_NEWS_VOID:
      CHECK(news->clearance != NULL && news->clearance->cause != NULL);
      return;
    case COLLISION_NEWS_DESCRIPTION:
      CHECK(news->description->radius_m > 0 && news->description->name != NULL);
      CHECK(news->description->acceleration_max_m_s2 > 0 && strcmp(news->text, "") != 0);
      CHECK(isnan(news->description->speed_max_m_s));
      return;
    case COLLISION_NEWS_STATE:
      CHECK(news->state->orientation[0] == 1 && news->agent.simulator != 0);
      return;
    case COLLISION_NEWS_CLOCK:
      CHECK(news->clock->lock_step == 1 && strcmp(news->clock->name, "") != 0);
      return;
    case COLLISION_NEWS_NOTICE:
      CHECK(news->notice >= COLLISION_NOTICE_NO_SERVICE);
      CHECK(news->notice <= COLLISION_NOTICE_CREDENTIALS && strcmp(news->text, "") != 0);
      return;
    case COLLISION_NEWS_EARLIEST:
      CHECK(news->earliest->found == 0 || news->earliest->earliest_ns >= 0);
      return;
    default:
      return;
  }
}

static void hear_all(collision_world* world, collision_monitor* monitor, heard* own, heard* seen) {
  const collision_news* news;
  while ((news = collision_world_next(world)) != NULL) hear(news, own);
  REQUIRE(collision_monitor_poll(monitor, 0) == COLLISION_OK);
  while ((news = collision_monitor_next(monitor)) != NULL) hear(news, seen);
}

static void part_meeting(void) {
  collision_world* world = connected("two-balls");
  collision_monitor* monitor = opened();
  const collision_tag tag = {"kind", "ball"};
  collision_agent_description ada = ball("ada", 0.5), bob = ball("bob", NAN);
  collision_agent_description third = ball("third", 0.5), wrong = ball("wrong", NAN);
  collision_solid solid;
  collision_shape* shape = NULL;
  collision_agent agents[3], none = 0;
  collision_agent_id id;
  collision_traffic traffic;
  collision_clearance clearances[2];
  /* As a program of a later version has them: with more members at the end. */
  struct {
    collision_state state;
    double more[2];
  } states[2];
  collision_state state;
  heard own, seen;
  int64_t t_ns = 0;
  int i;
  memset(&own, 0, sizeof own);
  memset(&seen, 0, sizeof seen);
  memset(states, 0, sizeof states);

  REQUIRE(collision_world_join(world, PATIENCE, &t_ns) == COLLISION_OK);
  CHECK(t_ns == 0);
  memset(&solid, 0, sizeof solid);
  solid.kind = COLLISION_BALL;
  solid.rounding_m = 0.5;
  REQUIRE(made(NULL, 0, 0, &solid, &shape) == COLLISION_OK);
  ada.tags = bob.tags = &tag;
  ada.tags_count = bob.tags_count = 1;
  bob.shape = shape;
  state = moving(0, -10, 2);
  REQUIRE(collision_world_add_agent(world, &ada, &state, &agents[0]) == COLLISION_OK);
  state = moving(0, 10, -2);
  REQUIRE(collision_world_add_agent(world, &bob, &state, &agents[1]) == COLLISION_OK);
  collision_shape_destroy(shape); /* The agent keeps it. */
  CHECK(collision_world_add_agent(world, &wrong, &state, &none) == COLLISION_INVALID);
  CHECK(says("radius_m") && none == 0);
  CHECK(collision_world_describe_agent(world, agents[0], &wrong) == COLLISION_INVALID);
  ada.margin_m = 0;
  ada.speed_max_m_s = NAN;
  CHECK(collision_world_describe_agent(world, agents[0], &ada) == COLLISION_OK);
  CHECK(collision_world_agent_id(world, agents[0], &id) == COLLISION_OK && id.simulator != 0);
  CHECK(strcmp(collision_world_name(world, id), "ada") == 0);
  CHECK(collision_world_agent_id(world, 0, &id) == COLLISION_INVALID && says("agent: 0"));

  for (t_ns = 0; t_ns <= 8 * SECOND; t_ns += SECOND / 10) {
    for (i = 0; i < 2; ++i) {
      states[i].state = moving(t_ns, i == 0 ? -10 : 10, i == 0 ? 2 : -2);
      states[i].state.struct_size = sizeof states[i];
    }
    REQUIRE(collision_world_set_states(world, agents, &states[0].state, 2) == COLLISION_OK);
    REQUIRE(collision_world_advance_to(world, t_ns, PATIENCE) == COLLISION_OK);
    CHECK(collision_world_clock_ns(world) == t_ns);
    CHECK(collision_world_granted_until_ns(world) >= t_ns);
    hear_all(world, monitor, &own, &seen);
  }
  CHECK(collision_world_lock_step(world) == 1);
  CHECK(own.confirmed > 0 && own.ended == 1 && own.events_without_names == 0);
  CHECK(own.begin.earliest_ns <= 4750000000 && own.begin.latest_ns >= 4750000000);
  CHECK(own.begin.latest_ns - own.begin.earliest_ns < SECOND / 100);

  /* What is wrong with one of several is told with its place. */
  states[1].state.position_m[0] = NAN;
  CHECK(collision_world_set_states(world, agents, &states[0].state, 2) == COLLISION_INVALID);
  CHECK(says("states[1]: ") && says("position_m"));
  CHECK(collision_world_publish(world, SECOND) == COLLISION_INVALID && says("clock_ns"));
  CHECK(collision_world_join(world, 0, &t_ns) == COLLISION_MISUSED);
  CHECK(collision_world_clearances(world, agents, clearances, sizeof clearances[0], 2) ==
        COLLISION_OK);
  CHECK(collision_world_clearances(world, agents, clearances, 0, 2) == COLLISION_INVALID);
  CHECK(collision_world_traffic(world, &traffic, 0) == COLLISION_INVALID && says("size: 0"));
  wrong.tags = &tag;
  wrong.tags_count = SIZE_MAX;
  wrong.radius_m = 1;
  CHECK(collision_world_describe_agent(world, agents[0], &wrong) == COLLISION_INVALID);
  CHECK(says("tags: "));
  CHECK(clearances[0].struct_size == sizeof clearances[0] && clearances[1].cause != NULL);
  CHECK(clearances[0].clear_until_ns > 0 && clearances[1].expires_ns == COLLISION_NEVER);

  /* A third one has no room here, and ada breaks what it declared. */
  state = moving(8 * SECOND, 500, 0);
  CHECK(collision_world_add_agent(world, &third, &state, &agents[2]) == COLLISION_OK);
  state = moving(8 * SECOND + SECOND / 10, 0, 2);
  state.position_m[0] = 1000;
  CHECK(collision_world_set_states(world, agents, &state, 1) == COLLISION_OK);
  for (t_ns = 8 * SECOND + SECOND / 10; t_ns <= 60 * SECOND; t_ns += SECOND / 10) {
    const int is_told = own.refused_for_room > 0 && seen.breached_acceleration > 0 &&
                        seen.refused_for_room > 0 && seen.ended > 0 &&
                        seen.kinds[COLLISION_NEWS_EARLIEST] > 0;
    if (is_told && seen.kinds[COLLISION_NEWS_STATUS] > 0) break;
    REQUIRE(collision_world_advance_to(world, t_ns, PATIENCE) == COLLISION_OK);
    CHECK(collision_world_poll(world, SECOND / 10) == COLLISION_OK);
    hear_all(world, monitor, &own, &seen);
  }
  CHECK(own.refused_for_room > 0 && seen.refused_for_room > 0);
  CHECK(seen.breached_acceleration > 0 && seen.confirmed > 0 && seen.ended == 1);
  CHECK(own.kinds[COLLISION_NEWS_VOID] > 0 && own.kinds[COLLISION_NEWS_NOTICE] > 0);
  CHECK(seen.kinds[COLLISION_NEWS_STATUS] > 0 && seen.kinds[COLLISION_NEWS_CLEARANCE] > 0);
  CHECK(seen.kinds[COLLISION_NEWS_DESCRIPTION] > 1 && seen.kinds[COLLISION_NEWS_STATE] > 1);
  CHECK(seen.kinds[COLLISION_NEWS_CLOCK] > 1 && seen.kinds[COLLISION_NEWS_EARLIEST] > 0);
  CHECK(collision_monitor_service_alive(monitor) == 1);
  CHECK(collision_monitor_contacts_missed(monitor) == 0);
  CHECK(collision_monitor_news_lost(monitor) == 0);
  CHECK(collision_world_contacts_missed(world) == 0 && collision_world_news_lost(world) == 0);
  CHECK(collision_world_traffic(world, &traffic, sizeof traffic) == COLLISION_OK);
  CHECK(traffic.states_set > 160 && traffic.states_sent > 0 && traffic.bytes_sent > 0);

  CHECK(collision_world_remove_agent(world, agents[2]) == COLLISION_OK);
  CHECK(collision_world_remove_agent(world, agents[2]) == COLLISION_INVALID);
  CHECK(collision_world_finish(world) == COLLISION_OK);
  collision_world_close(world);
  for (i = 0; i < 2400 && seen.kinds[COLLISION_NEWS_REMOVAL] < 2; ++i) {
    const collision_news* news;
    REQUIRE(collision_monitor_poll(monitor, SECOND / 10) == COLLISION_OK);
    while ((news = collision_monitor_next(monitor)) != NULL) hear(news, &seen);
  }
  CHECK(seen.kinds[COLLISION_NEWS_REMOVAL] >= 2);
  collision_monitor_close(monitor);
}

/* ---- What happens to a simulator ---- */

static int comes(collision_world* world, int kind, const char* text) {
  const collision_news* news;
  int i;
  for (i = 0; i < 2400; ++i) {
    REQUIRE(collision_world_poll(world, SECOND / 10) == COLLISION_OK);
    while ((news = collision_world_next(world)) != NULL) {
      if (news->kind == kind && strstr(news->text, text) != NULL) return 1;
    }
  }
  return 0;
}

/* Ada is waited for, and is then evicted; another of its name waits. */
static void part_trouble(void) {
  collision_world* ada = connected("ada");
  collision_world* bob = connected("bob");
  collision_world* twin = NULL;
  collision_agent_description description = ball("agent", 1);
  collision_state state = moving(0, 0, 0);
  collision_agent agent;
  REQUIRE(collision_world_add_agent(ada, &description, &state, &agent) == COLLISION_OK);
  state = moving(0, 1000, 0);
  REQUIRE(collision_world_add_agent(bob, &description, &state, &agent) == COLLISION_OK);
  REQUIRE(collision_world_publish(ada, 0) == COLLISION_OK);
  REQUIRE(collision_world_advance_to(bob, 0, PATIENCE) == COLLISION_OK);
  CHECK(collision_world_advance_to(bob, 100 * SECOND, SECOND / 10) == COLLISION_TIMEOUT);
  CHECK(comes(bob, COLLISION_NEWS_WAITING, "ada"));
  CHECK(collision_world_waits_for_name(bob) == NULL);

  twin = connected("bob");
  REQUIRE(collision_world_publish(twin, 0) == COLLISION_OK);
  CHECK(comes(twin, COLLISION_NEWS_NOTICE, "bob"));
  CHECK(collision_world_waits_for_name(twin) != NULL);
  collision_world_close(twin);

  printf("evict ada\n");
  fflush(stdout);
  CHECK(comes(ada, COLLISION_NEWS_NOTICE, "evicted"));
  REQUIRE(collision_world_ended_because(ada) != NULL);
  CHECK(strstr(collision_world_ended_because(ada), "evicted") != NULL);
  CHECK(collision_world_ended_because(bob) == NULL);
  CHECK(collision_world_advance_to(ada, 1000 * SECOND, SECOND / 10) == COLLISION_MISUSED);
  CHECK(says("the run has ended: "));
  collision_world_close(ada);

  printf("stop the service\n");
  fflush(stdout);
  CHECK(comes(bob, COLLISION_NEWS_SERVICE_LOST, ""));
  printf("start the service\n");
  fflush(stdout);
  CHECK(comes(bob, COLLISION_NEWS_SERVICE_BACK, ""));
  collision_world_close(bob);
}

static int64_t told_time(void* user) {
  ++*(int*)user;
  return INT64_C(1900000000000000000);
}

/* In real time the clock of the program counts. */
static void part_real_time(void) {
  collision_world_options options;
  collision_world* world = NULL;
  int64_t now_ns = 0;
  int asked = 0;
  collision_world_options_init(&options, sizeof options);
  options.world = world_name;
  options.domain = domain;
  options.simulator = "clock";
  options.lock_step = 0;
  options.wall_clock = told_time;
  options.wall_clock_user = &asked;
  REQUIRE(collision_world_connect(&options, &world) == COLLISION_OK);
  CHECK(collision_world_join(world, 0, &now_ns) == COLLISION_OK);
  CHECK(now_ns == INT64_C(1900000000000000000) && asked > 0);
  collision_world_close(world);
}

/* Its agent stays with the service. */
static void part_leaves_agents(void) {
  collision_world_options options;
  collision_world* world = NULL;
  collision_agent_description description = ball("stays", 1);
  const collision_state state = moving(0, 0, 0);
  collision_agent agent;
  collision_world_options_init(&options, sizeof options);
  options.world = world_name;
  options.domain = domain;
  options.simulator = "leaves";
  options.leave_agents = 1;
  REQUIRE(collision_world_connect(&options, &world) == COLLISION_OK);
  REQUIRE(collision_world_wait_for_service(world, PATIENCE) == COLLISION_OK);
  REQUIRE(collision_world_add_agent(world, &description, &state, &agent) == COLLISION_OK);
  REQUIRE(collision_world_advance_to(world, 0, PATIENCE) == COLLISION_OK);
  REQUIRE(collision_world_advance_to(world, SECOND / 10, PATIENCE) == COLLISION_OK);
  collision_world_close(world);
}

/* ---- A secured world ---- */

static void part_secured(void) {
  collision_monitor_options others;
  collision_world_options options;
  collision_world* world = connected("ada-sim");
  collision_monitor* monitor = opened();
  collision_agent_description description = ball("ada", 1);
  collision_state state = moving(0, 0, 0);
  collision_agent agent;
  const collision_news* news;
  int i, seen = 0;
  REQUIRE(collision_world_add_agent(world, &description, &state, &agent) == COLLISION_OK);
  for (i = 0; i < 2400 && !seen; ++i) {
    state.stamp_ns = i * (SECOND / 10);
    REQUIRE(collision_world_set_states(world, &agent, &state, 1) == COLLISION_OK);
    REQUIRE(collision_world_advance_to(world, state.stamp_ns, PATIENCE) == COLLISION_OK);
    REQUIRE(collision_monitor_poll(monitor, SECOND / 10) == COLLISION_OK);
    while ((news = collision_monitor_next(monitor)) != NULL)
      seen |= news->kind == COLLISION_NEWS_STATE;
  }
  CHECK(seen);
  collision_monitor_close(monitor);
  collision_monitor_options_init(&others, sizeof others);
  others.world = world_name;
  others.domain = domain;
  others.credentials = others_credentials;
  CHECK(collision_monitor_open(&others, &monitor) < 0 && says("one process has one"));
  collision_world_close(world);
  collision_world_options_init(&options, sizeof options);
  options.simulator = "ada-sim";
  options.credentials = "/nowhere";
  CHECK(collision_world_connect(&options, &world) < 0 && says("/nowhere"));
}

/* PART [CREDENTIALS CREDENTIALS_OF_ANOTHER] WORLD DOMAIN */
int main(int argc, char** argv) {
  if (argc != 4 && argc != 6) return 2;
  if (argc == 6) {
    credentials = argv[2];
    others_credentials = argv[3];
  }
  world_name = argv[argc - 2];
  domain = (uint32_t)strtoul(argv[argc - 1], NULL, 10);
  if (strcmp(argv[1], "alone") == 0) part_alone();
  if (strcmp(argv[1], "meeting") == 0) part_meeting();
  if (strcmp(argv[1], "trouble") == 0) part_trouble();
  if (strcmp(argv[1], "real-time") == 0) part_real_time();
  if (strcmp(argv[1], "leaves-agents") == 0) part_leaves_agents();
  if (strcmp(argv[1], "secured") == 0) part_secured();
  return failures > 0 ? 1 : 0;
}
