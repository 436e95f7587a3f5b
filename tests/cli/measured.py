"""usage: measured.py USAGE ENVIRONMENT COMMAND...: runs COMMAND, and writes its exit code, seconds of processor time and peak
resident bytes to the file USAGE as JSON. ENVIRONMENT is a JSON object."""
import json
import os
import sys

usage_file, environment, *command = sys.argv[1:]
running = os.posix_spawnp(command[0], command, json.loads(environment))
_, status, usage = os.wait4(running, 0)
with open(usage_file, "w", encoding="utf-8") as file:
    json.dump([os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime, usage.ru_maxrss << 10], file)
