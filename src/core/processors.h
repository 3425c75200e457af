/* Processors: how many by affinity and quota. */
#ifndef BURNISH_CORE_PROCESSORS_H
#define BURNISH_CORE_PROCESSORS_H

/* The processors that a control group's "QUOTA PERIOD" allows, rounded up; 0 for no limit. */
int burnish_quota_processors(const char *text);

#endif
