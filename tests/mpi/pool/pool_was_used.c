/* 1 if this process has shared its arrays with a pool; the shared memory has a name. */
#include <stdio.h>
#include <string.h>

int pool_was_used(void) {
  char line[4096];
  int used = 0;
  FILE* const maps = fopen("/proc/self/maps", "r");
  while (maps != NULL && fgets(line, sizeof line, maps) != NULL)
    used |= strstr(line, "/memfd:pstripack") != NULL;
  if (maps != NULL) fclose(maps);
  return used;
}
