/* A simulator in C: two balls that meet, in step with all simulators of their world. */
#include <stdio.h>

#include <collision/collision.h>

#define SECOND 1000000000LL

static collision_state at(int64_t t_ns, double x_m, double speed_m_s) {
  collision_state state;
  collision_state_init(&state, sizeof state);
  state.stamp_ns = t_ns;
  state.position_m[0] = x_m + speed_m_s * 1e-9 * (double)t_ns;
  state.velocity_m_s[0] = speed_m_s;
  return state;
}

static int failed(const char* what) {
  fprintf(stderr, "%s: %s\n", what, collision_error());
  return 1;
}

int main(void) {
  const char* names[2] = {"ada", "bob"};
  const double x_m[2] = {-10, 10}, speed_m_s[2] = {2, -2};
  collision_world_options options;
  collision_agent_description ball;
  collision_world* world = NULL;
  collision_agent agents[2];
  const collision_news* news;
  int64_t t_ns;
  int i;

  collision_world_options_init(&options, sizeof options);
  options.simulator = "two-balls";
  if (collision_world_connect(&options, &world) != COLLISION_OK) return failed("connect");

  collision_agent_description_init(&ball, sizeof ball);
  ball.radius_m = 0.5;
  ball.acceleration_max_m_s2 = 1;
  for (i = 0; i < 2; ++i) {
    const collision_state state = at(0, x_m[i], speed_m_s[i]);
    ball.name = names[i];
    if (collision_world_add_agent(world, &ball, &state, &agents[i]) != COLLISION_OK) {
      return failed(names[i]);
    }
  }

  for (t_ns = 0; t_ns <= 10 * SECOND; t_ns += SECOND / 10) {
    collision_state states[2];
    for (i = 0; i < 2; ++i) states[i] = at(t_ns, x_m[i], speed_m_s[i]);
    if (collision_world_set_states(world, agents, states, 2) != COLLISION_OK) {
      return failed("states");
    }
    if (collision_world_advance_to(world, t_ns, 10 * SECOND) != COLLISION_OK) {
      fprintf(stderr, "no time was granted\n");
      return 1;
    }
    while ((news = collision_world_next(world)) != NULL) {
      if (news->kind == COLLISION_NEWS_EVENT) printf("%s\n", news->event->sentence);
    }
  }
  collision_world_close(world);
  return 0;
}
