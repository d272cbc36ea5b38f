#!/usr/bin/env bash
# Stands in for `rrp` in the harness's own tests: same words, no page.
trap 'echo "asked to end" >&2; exit "${END_CODE:-0}"' TERM
listen=${3/%:0/:4242}
echo "logs: $*" >&2
[[ "$*" == *broken* ]] && { echo "the disk is gone" >&2; exit 3; }
[[ "$*" == *rude* ]] && END_CODE=7
echo "a line before"
echo "rrp is ready: http://$listen/"
while :; do sleep 0.05; done
