# What the tests in a real window share; sourced. Sets up a virtual display and a folder of its own
# in $work, where $studio runs. Nothing here sleeps for a fixed time to let something happen: it
# polls the window's title, its picture or a file.
command -v Xvfb > /dev/null || { echo "skipped: Xvfb is not installed"; exit 77; }
command -v xdotool > /dev/null || { echo "xdotool is missing (Debian: xdotool)"; exit 1; }
command -v ffmpeg > /dev/null || { echo "ffmpeg is missing (Debian: ffmpeg)"; exit 1; }

work=$(mktemp -d)
studio='' server='' window=''
cleanup() {
  if [ -n "$studio" ]; then kill "$studio" 2> /dev/null || true; fi
  if [ -n "$server" ]; then kill "$server" 2> /dev/null || true; fi
  rm -rf "$work"
}
trap cleanup EXIT
fail() {
  echo "FAILED: $1"
  [ -n "$window" ] && keep_picture failed
  cat "$work/log" 2> /dev/null || true
  exit 1
}

# until_true SECONDS COMMAND...
until_true() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ "$SECONDS" -lt "$end" ] || return 1
    sleep 0.05
  done
}
title() { xdotool getwindowname "$window"; }
has_title() { [ "$(title)" = "$1" ]; }
wait_title() { until_true 60 has_title "$1" || fail "the title is \"$(title)\", not \"$1\""; }
gone() { ! kill -0 "$studio" 2> /dev/null; }

grab() { ffmpeg -loglevel error -y -f x11grab -video_size 1440x900 -draw_mouse 0 -i "$DISPLAY" -frames:v 1 "$@" < /dev/null; }
look() { grab -f md5 -; }
# Until the picture is another than $seen, and rests. Then that is what was seen.
seen=''
another_picture() {
  local now
  now=$(look)
  [ "$now" != "$seen" ] || return 1
  [ "$now" = "$(look)" ] || return 1
  seen=$now
}
wait_picture() { until_true 60 another_picture || fail "nothing happens on screen: $1"; }
keep_picture() { grab "$out/$1.png"; }

start_display() {
  Xvfb -displayfd 3 -screen 0 1440x900x24 -nolisten tcp 3> "$work/display" 2> /dev/null &
  server=$!
  until_true 20 test -s "$work/display" || fail "Xvfb does not start"
  DISPLAY=:$(cat "$work/display")
  export DISPLAY
  unset WAYLAND_DISPLAY
  export WINSLOW_PROFILE="$work/profile"
}

# start_studio ARGUMENTS...: in $work
start_studio() {
  cd "$work" || exit 1
  "$winslow" studio "$@" > log 2>&1 &
  studio=$!
  window=$(timeout 60 xdotool search --sync --onlyvisible --name winslow | head -1) ||
    fail "no window appears"
}
