/* A plug-in in plain C, and with one -D after another all that can be wrong with one.
   Its detector answers with the whole picture, its tracker with the start box. */
#include <relock/core/plugin_abi.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifndef ABI
#define ABI RELOCK_PLUGIN_ABI
#endif
#ifndef TABLE_SIZE
#define TABLE_SIZE sizeof(relock_plugin)
#endif
#ifndef NAME
#define NAME "plain"
#endif
#ifndef METHOD
#define METHOD "whole"
#endif
#ifndef METHODS
#define METHODS methods
#endif
#ifndef SECOND
#define SECOND "stays"
#endif
#ifndef OPTION
#define OPTION "margin"
#endif
#ifndef OPTION_COUNT
#define OPTION_COUNT 2
#endif
#ifndef DETECT
#define DETECT detect
#endif
#ifndef STAGE
#define STAGE "it rises"
#endif
#ifndef AT_ENTRY
#define AT_ENTRY
#endif
#ifndef AT_CREATE
#define AT_CREATE
#endif
#ifndef AT_TRACK
#define AT_TRACK
#endif
#ifndef PLACES
#define PLACES 1
#endif

void crash(void);
void crash(void) {
  volatile int* nowhere = NULL;
  *nowhere = 1;
}

#ifdef AT_LOAD_DO
__attribute__((constructor)) static void at_load(void) { AT_LOAD_DO; }
#endif

static void reads(void* own, const relock_setting* settings, uint64_t count, const relock_answer* answer) {
  (void)own, (void)settings, (void)count;
  answer->code_family(answer->host, "plain");
}

static void* create(void* own, const relock_setting* settings, uint64_t count, uint64_t seed,
                    const relock_answer* answer) {
  (void)own, (void)seed, (void)answer;
  for (uint64_t i = 0; i < count; ++i)
    if (strcmp(settings[i].name, "margin") == 0 && settings[i].value[0] == '-') {
      answer->error(answer->host, "whole: a margin cannot be negative");
      return NULL;
    }
  AT_CREATE;
  return calloc(1, sizeof(relock_box));
}

static void box_around(const relock_box* box, relock_sighting* seen) {
  memset(seen, 0, sizeof *seen);
  seen->size = sizeof *seen;
  seen->centre_x = box->x + box->width / 2;
  seen->centre_y = box->y + box->height / 2;
  seen->outline_kind = RELOCK_OUTLINE_BOX;
  memcpy(seen->outline, box, sizeof *box);
  seen->confidence = 1;
  seen->blur_length_px = -1;
}

static void detect(void* object, const relock_image* image, const relock_box* where,
                   const relock_answer* answer) {
  const relock_box all = {-0.5, -0.5, image->width, image->height};
  relock_sighting seen;
  (void)object, (void)where;
  box_around(&all, &seen);
  seen.code_family = "plain";
  seen.code_value = "1";
  answer->sighting(answer->host, &seen);
}

/* A picture of two pixels, and a chart. */
static int explain(void* object, const relock_image* image, const relock_box* where,
                   const relock_answer* answer) {
  static const uint8_t pixels[] = {10, 20};
  static const double points[] = {0, 1, 1, 3};
  static const relock_curve curve = {"", points, 2};
  relock_stage stage = {sizeof stage, "shades", "two of them", {pixels, 2, 2, 1, RELOCK_GRAY8, 0},
                        NULL,         NULL,     NULL,          0};
  (void)object, (void)where;
  if (!image) return 1;
  answer->stage(answer->host, &stage);
  memset(&stage.picture, 0, sizeof stage.picture);
  stage.name = "profile", stage.sentence = STAGE, stage.x = "x [px]", stage.y = "level";
  stage.curves = &curve, stage.curve_count = 1;
  answer->stage(answer->host, &stage);
  return 1;
}

static void start(void* object, const relock_frame* frame, const relock_box* box,
                  const relock_answer* answer) {
  (void)frame, (void)answer;
  memcpy(object, box, sizeof *box);
}

static void track(void* object, const relock_frame* frame, const relock_answer* answer) {
  relock_sighting seen;
  (void)frame;
  AT_TRACK;
  box_around(object, &seen);
  for (int i = 0; i < PLACES; ++i) answer->sighting(answer->host, &seen);
}

static const relock_option options[] = {
    {OPTION, "0", "px", "how much of the picture's border is left out"},
    {"shade", "dark", "", "what it looks for"},
};
static const relock_method methods[] = {
    {RELOCK_DETECTOR, 0, METHOD, "the whole picture", options, OPTION_COUNT, NULL, reads, create, free,
     DETECT, NULL, NULL, NULL, explain},
    {RELOCK_TRACKER, 0, SECOND, "the start box", NULL, 0, NULL, NULL, create, free, NULL, start, track, NULL,
     NULL},
};

#ifndef NO_ENTRY
const relock_plugin* relock_plugin_v1(uint32_t abi) {
  static const relock_plugin table = {
      ABI, TABLE_SIZE, sizeof(relock_method), sizeof(relock_option), NAME, NULL, METHODS, 2};
#ifdef MISSING
  void missing_function(void);
  missing_function();
#endif
  AT_ENTRY;
  return abi == RELOCK_PLUGIN_ABI ? &table : NULL;
}
#endif
