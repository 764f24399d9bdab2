/* SPDX-License-Identifier: GPL-2.0-or-later
 * A structure of an outside project, compiled as C against the installed header alone: a square plate that
 * can only rise and sink, on a spring; one node for all its corners, which hang on it and on four that stay.
 */
#include <coupling/plugin/structure_plugin.h>
#include <stddef.h>
#include <string.h>

struct StructurePluginBody {
  double z, v, a, dt;
};

typedef struct StructurePluginBody Plate;

enum { kNodes = 5 };
static const double mass = 1e-3, stiffness = 1e3;
static const double corner[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
static Plate plate;

static int open_plate(const StructurePluginSetup* setup, Plate** body) {
  memset(&plate, 0, sizeof plate);
  *body = &plate;
  return setup->size == sizeof *setup ? 0 : 1;
}
static void close_plate(Plate* body) { (void)body; }
static const char* last_error(const Plate* body) { return body ? "" : "another header"; }

static int describe(Plate* body, StructurePluginDescription* is) {
  static const double knots[4] = {0, 0, 1, 1};
  static const StructurePluginPatch patch = {{1, 1}, {4, 4}, {knots, knots}, NULL, 1};
  static const int64_t first[5] = {0, 2, 4, 6, 8}, node[8] = {0, 1, 0, 2, 0, 3, 0, 4};
  static const double factor[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  (void)body;
  is->units = "si";
  is->patch_count = 1;
  is->patches = &patch;
  is->node_count = is->own_count = kNodes;
  is->first = first;
  is->node = node;
  is->factor = factor;
  return 0;
}

static int stable_step(Plate* body, double* dt) {
  (void)body;
  *dt = 2e-3; /* 2 sqrt(m / k) */
  return 0;
}
static int set_time_step(Plate* body, double dt) {
  body->dt = dt;
  return 0;
}
static int initialise(Plate* body, const double* forces) {
  body->a = (forces[2] - stiffness * body->z) / mass;
  return 0;
}
static int begin_step(Plate* body) {
  body->v += 0.5 * body->dt * body->a;
  body->z += body->dt * body->v;
  return 0;
}
static int end_step(Plate* body, const double* forces) {
  initialise(body, forces);
  body->v += 0.5 * body->dt * body->a;
  return 0;
}
static int motion(Plate* body, double* x, double* v) {
  memset(x, 0, 3 * kNodes * sizeof *x);
  memset(v, 0, 3 * kNodes * sizeof *v);
  x[2] = body->z;
  v[2] = body->v;
  for (int i = 0; i < 4; ++i) memcpy(x + 3 * (i + 1), corner[i], sizeof corner[i]);
  return 0;
}
static int totals(Plate* body, StructurePluginTotals* sums) {
  sums->kinetic_energy = 0.5 * mass * body->v * body->v;
  sums->strain_energy = 0.5 * stiffness * body->z * body->z;
  sums->linear_momentum[2] = mass * body->v;
  return 0;
}
static int save(Plate* body, void* bytes, int64_t* size) {
  *size = sizeof *body;
  if (bytes) memcpy(bytes, body, sizeof *body);
  return 0;
}
static int load(Plate* body, const void* bytes, int64_t size) {
  if (size != sizeof *body) return 1;
  memcpy(body, bytes, sizeof *body);
  return 0;
}

static const StructurePlugin table = {STRUCTURE_PLUGIN_VERSION,
                                      sizeof table,
                                      "oscillator",
                                      open_plate,
                                      close_plate,
                                      last_error,
                                      describe,
                                      stable_step,
                                      set_time_step,
                                      initialise,
                                      begin_step,
                                      end_step,
                                      motion,
                                      totals,
                                      save,
                                      load,
                                      NULL};

const StructurePlugin* structure_plugin(uint32_t version);
const StructurePlugin* structure_plugin(uint32_t version) {
  return version == STRUCTURE_PLUGIN_VERSION ? &table : NULL;
}
