/* SPDX-License-Identifier: GPL-2.0-or-later
 * An outside structure code, as small as it can be and still be one: masses on a rectangular grid, tied to
 * their neighbours by springs, and to where they were by others.  They are the control points of a B-spline
 * surface.  It is plain C99 and shares nothing with this project but structure_plugin.h.
 *
 * Its model file, one word and its numbers a line:
 *   nodes NX NY         of masses
 *   origin X Y Z        of the first of them
 *   size LX LY          of the net
 *   degree P            of the surface, below NX and NY
 *   mass M              of a node
 *   stiffness K         of a spring between neighbours
 *   rest S              their length without force, over the distance of the nodes; < 1: the net is stretched
 *   ground K            of the spring between each node and where it was
 *   held BORDERS        1: the masses along the four sides stay where they are
 *   parts PARTS         1: each rank has the masses of some rows; 0: every rank has all
 *   fault KIND STEP RANK  for tests: 1 an error of end_step, 2 a velocity that is no number, of open if STEP
 * is 0
 */
#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "coupling/plugin/structure_plugin.h"

#ifndef NET_VERSION
#define NET_VERSION STRUCTURE_PLUGIN_VERSION
#endif

struct StructurePluginBody {
  MPI_Comm comm;
  int me, ranks;
  int nx, ny, degree, held, parts;
  double origin[3], size[2], mass, stiffness, rest, ground;
  int fault, fault_step, fault_rank;
  int first, end;        /* own nodes */
  double *X, *x, *v, *a; /* [nx ny][3]; v and a of own nodes alone */
  double* before;        /* velocities before a half kick */
  double *knots[2], *inverse_mass;
  int64_t* own;
  double dt;
  int step, is_within_step;
  StructurePluginPatch patch;
  char error[256];
};

typedef struct StructurePluginBody Net;

static char open_error[256];

static int node_count(const Net* net) { return net->nx * net->ny; }

static int is_held(const Net* net, int node) {
  const int i = node % net->nx, j = node / net->nx;
  return net->held && (i == 0 || j == 0 || i == net->nx - 1 || j == net->ny - 1);
}

static int fail(Net* net, int code, const char* text) {
  snprintf(net->error, sizeof net->error, "%s, in step %d on rank %d", text, net->step, net->me);
  return code;
}

static int fails_now(const Net* net, int kind) {
  return net->fault == kind && net->fault_step == net->step && net->fault_rank == net->me;
}

static int read_model(Net* net, const char* path) {
  char word[32];
  FILE* file = fopen(path, "r");
  if (!file) {
    snprintf(open_error, sizeof open_error, "cannot read '%s'", path);
    return 2;
  }
  while (fscanf(file, "%31s", word) == 1) {
    int wrong = 1;
    if (!strcmp(word, "nodes")) wrong = fscanf(file, "%d %d", &net->nx, &net->ny) != 2;
    if (!strcmp(word, "origin"))
      wrong = fscanf(file, "%lf %lf %lf", &net->origin[0], &net->origin[1], &net->origin[2]) != 3;
    if (!strcmp(word, "size")) wrong = fscanf(file, "%lf %lf", &net->size[0], &net->size[1]) != 2;
    if (!strcmp(word, "degree")) wrong = fscanf(file, "%d", &net->degree) != 1;
    if (!strcmp(word, "mass")) wrong = fscanf(file, "%lf", &net->mass) != 1;
    if (!strcmp(word, "stiffness")) wrong = fscanf(file, "%lf", &net->stiffness) != 1;
    if (!strcmp(word, "rest")) wrong = fscanf(file, "%lf", &net->rest) != 1;
    if (!strcmp(word, "ground")) wrong = fscanf(file, "%lf", &net->ground) != 1;
    if (!strcmp(word, "held")) wrong = fscanf(file, "%d", &net->held) != 1;
    if (!strcmp(word, "parts")) wrong = fscanf(file, "%d", &net->parts) != 1;
    if (!strcmp(word, "fault"))
      wrong = fscanf(file, "%d %d %d", &net->fault, &net->fault_step, &net->fault_rank) != 3;
    if (wrong) {
      snprintf(open_error, sizeof open_error, "%s: '%s' is no word of a net, or lacks its numbers", path,
               word);
      fclose(file);
      return 3;
    }
  }
  fclose(file);
  return 0;
}

static double* uniform_knots(int degree, int control_points) {
  const int count = control_points + degree + 1, elements = control_points - degree;
  double* knots = malloc(sizeof(double) * (size_t)count);
  for (int k = 0; k < count; ++k) {
    const int element = k - degree;
    knots[k] = element < 0 ? 0.0 : element > elements ? 1.0 : (double)element / elements;
  }
  return knots;
}

static void lay_out(Net* net) {
  const int n = node_count(net);
  const size_t bytes = sizeof(double) * 3 * (size_t)n;
  net->X = malloc(bytes);
  net->x = malloc(bytes);
  net->v = calloc(1, bytes);
  net->a = calloc(1, bytes);
  net->before = calloc(1, bytes);
  for (int node = 0; node < n; ++node) {
    net->X[3 * node] = net->origin[0] + net->size[0] * (node % net->nx) / (net->nx - 1);
    net->X[3 * node + 1] = net->origin[1] + net->size[1] * (node / net->nx) / (net->ny - 1);
    net->X[3 * node + 2] = net->origin[2];
  }
  memcpy(net->x, net->X, bytes);
  net->first = net->parts ? net->nx * (net->ny * net->me / net->ranks) : 0;
  net->end = net->parts ? net->nx * (net->ny * (net->me + 1) / net->ranks) : n;
  net->own = malloc(sizeof(int64_t) * (size_t)(net->end - net->first + 1));
  net->inverse_mass = malloc(bytes);
  for (int node = net->first; node < net->end; ++node) {
    net->own[node - net->first] = node;
    for (int i = 0; i < 3; ++i)
      net->inverse_mass[3 * (node - net->first) + i] = is_held(net, node) ? 0.0 : 1.0 / net->mass;
  }
  net->knots[0] = uniform_knots(net->degree, net->nx);
  net->knots[1] = uniform_knots(net->degree, net->ny);
}

static void net_close(Net* net) {
  MPI_Comm_free(&net->comm);
  free(net->X), free(net->x), free(net->v), free(net->a), free(net->before);
  free(net->knots[0]), free(net->knots[1]), free(net->inverse_mass), free(net->own);
  free(net);
}

static int net_open(const StructurePluginSetup* setup, Net** body) {
  Net* net = calloc(1, sizeof *net);
  int code;
  net->rest = 1.0;
  net->fault_step = -1;
  code = read_model(net, setup->model);
  if (code == 0 &&
      (net->degree < 1 || net->nx <= net->degree || net->ny <= net->degree || !(net->mass > 0.0))) {
    snprintf(open_error, sizeof open_error, "%s: nodes, degree or mass is missing or too small",
             setup->model);
    code = 4;
  }
  if (code != 0) {
    free(net);
    return code;
  }
  MPI_Comm_dup(MPI_Comm_f2c(setup->communicator), &net->comm);
  MPI_Comm_rank(net->comm, &net->me);
  MPI_Comm_size(net->comm, &net->ranks);
  lay_out(net);
  *body = net;
  return 0;
}

static const char* net_last_error(const Net* net) { return net ? net->error : open_error; }

static int net_describe(Net* net, StructurePluginDescription* is) {
  is->units = "si";
  for (int d = 0; d < 2; ++d) {
    net->patch.degree[d] = net->degree;
    net->patch.knot_count[d] = (d == 0 ? net->nx : net->ny) + net->degree + 1;
    net->patch.knots[d] = net->knots[d];
  }
  net->patch.outward = 1; /* a net has two sides, a wall under particles its upper one */
  is->patch_count = 1;
  is->patches = &net->patch;
  is->node_count = node_count(net);
  is->in_parts = net->parts;
  is->own_count = net->end - net->first;
  is->own = net->own;
  is->inverse_mass = net->inverse_mass;
  return 0;
}

/* f += the force of a spring between two nodes on the first of them; its energy. */
static double pull(const Net* net, int node, int other, double f[3]) {
  const double *x = net->x + 3 * node, *y = net->x + 3 * other, *X = net->X + 3 * node,
               *Y = net->X + 3 * other;
  const double d[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
  const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const double rest = net->rest * (fabs(Y[0] - X[0]) + fabs(Y[1] - X[1])); /* along an axis */
  const double stretch = length - rest;
  for (int i = 0; i < 3; ++i) f[i] += net->stiffness * stretch / length * d[i];
  return 0.5 * net->stiffness * stretch * stretch;
}

/* The same for all springs of a node, in an order that no rank changes. */
static double own_force(const Net* net, int node, double f[3]) {
  const int i = node % net->nx, j = node / net->nx;
  double springs = 0.0, ground = 0.0;
  f[0] = f[1] = f[2] = 0.0;
  if (i > 0) springs += pull(net, node, node - 1, f);
  if (i < net->nx - 1) springs += pull(net, node, node + 1, f);
  if (j > 0) springs += pull(net, node, node - net->nx, f);
  if (j < net->ny - 1) springs += pull(net, node, node + net->nx, f);
  for (int k = 0; k < 3; ++k) {
    const double u = net->x[3 * node + k] - net->X[3 * node + k];
    f[k] -= net->ground * u;
    ground += 0.5 * net->ground * u * u;
  }
  return 0.5 * springs + ground; /* two nodes share a spring */
}

static void accelerate(Net* net, const double* forces) {
  for (int node = net->first; node < net->end; ++node) {
    double f[3];
    own_force(net, node, f);
    for (int i = 0; i < 3; ++i)
      net->a[3 * node + i] =
          is_held(net, node) ? 0.0 : (f[i] + forces[3 * (node - net->first) + i]) / net->mass;
  }
}

static void half_kick(Net* net) {
  for (int k = 3 * net->first; k < 3 * net->end; ++k) net->v[k] += 0.5 * net->dt * net->a[k];
}

/* From the ranks of the rows to all: a net of parts needs the places of its neighbours. */
static void share(const Net* net, double* values) {
  int *counts, *offsets;
  if (!net->parts) return;
  counts = malloc(sizeof(int) * (size_t)net->ranks);
  offsets = malloc(sizeof(int) * (size_t)net->ranks);
  for (int r = 0; r < net->ranks; ++r) {
    offsets[r] = 3 * net->nx * (net->ny * r / net->ranks);
    counts[r] = 3 * net->nx * (net->ny * (r + 1) / net->ranks) - offsets[r];
  }
  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DOUBLE, values, counts, offsets, MPI_DOUBLE, net->comm);
  free(counts);
  free(offsets);
}

static int net_stable_step(Net* net, double* dt) {
  if (net->is_within_step) return fail(net, 9, "asked for the stable step within a step");
  /* no row of the stiffness has more in it than eight springs and the ground: Gershgorin's circle */
  *dt = 2.0 / sqrt((8.0 * net->stiffness + net->ground) / net->mass);
  return 0;
}

static int net_set_time_step(Net* net, double dt) {
  net->dt = dt;
  return 0;
}

static int net_initialise(Net* net, const double* forces) {
  accelerate(net, forces);
  return 0;
}

static int net_begin_step(Net* net) {
  ++net->step;
  net->is_within_step = 1;
  half_kick(net);
  for (int k = 3 * net->first; k < 3 * net->end; ++k) net->x[k] += net->dt * net->v[k];
  share(net, net->x);
  return 0;
}

static int net_end_step(Net* net, const double* forces) {
  if (fails_now(net, 1)) return fail(net, 7, "a spring has snapped");
  accelerate(net, forces);
  half_kick(net);
  net->is_within_step = 0;
  return 0;
}

static int net_motion(Net* net, double* x, double* v) {
  const size_t bytes = sizeof(double) * 3 * (size_t)(net->end - net->first);
  memcpy(x, net->x + 3 * net->first, bytes);
  memcpy(v, net->v + 3 * net->first, bytes);
  if (fails_now(net, 2)) v[4] = NAN;
  return 0;
}

static int net_totals(Net* net, StructurePluginTotals* totals) {
  for (int node = net->first; node < net->end; ++node) {
    const double *x = net->x + 3 * node, *v = net->v + 3 * node, m = net->mass;
    double f[3];
    totals->strain_energy += own_force(net, node, f);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      totals->kinetic_energy += 0.5 * m * v[i] * v[i];
      totals->linear_momentum[i] += m * v[i];
      totals->angular_momentum[i] += m * (x[j] * v[k] - x[k] * v[j]);
    }
  }
  return 0;
}

static int net_save(Net* net, void* bytes, int64_t* size) {
  const size_t half = sizeof(double) * 3 * (size_t)node_count(net);
  *size = (int64_t)(2 * half);
  if (!bytes) return 0;
  share(net, net->v);
  memcpy(bytes, net->x, half);
  memcpy((char*)bytes + half, net->v, half);
  return 0;
}

static int net_load(Net* net, const void* bytes, int64_t size) {
  const size_t half = sizeof(double) * 3 * (size_t)node_count(net);
  if (size != (int64_t)(2 * half)) return fail(net, 5, "a state of another net");
  memcpy(net->x, bytes, half);
  memcpy(net->v, (const char*)bytes + half, half);
  return 0;
}

static const StructurePlugin table = {NET_VERSION,
                                      sizeof(StructurePlugin),
                                      "spring net",
                                      net_open,
                                      net_close,
                                      net_last_error,
                                      net_describe,
                                      net_stable_step,
                                      net_set_time_step,
                                      net_initialise,
                                      net_begin_step,
                                      net_end_step,
                                      net_motion,
                                      net_totals,
                                      net_save,
                                      net_load,
                                      NULL};

const StructurePlugin* structure_plugin(uint32_t version);
const StructurePlugin* structure_plugin(uint32_t version) {
  (void)version;
  return &table;
}
