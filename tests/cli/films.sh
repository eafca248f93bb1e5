#!/usr/bin/env bash
# Films and scenes for POV-Ray, judged by ffprobe and povray; what is not installed is said and leaves that part out.
# usage: films.sh HEADRACED HEADRACE ROOT [RESULTS]
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"

cd "$work" || exit 1
"$headrace" run dam_break --until 0.05 --out . --format '' >run.txt 2>&1 || fail "run: $(cat run.txt)"
convert() { "$headrace" convert dam_break.mcap "$@"; }

# Without ffmpeg the remedy is told, and nothing is left.
mkdir empty
ln -s "$headrace" empty/headrace
PATH=empty expect 6 'error file_error \(format\): films need ffmpeg, .*apt-get install ffmpeg.*' \
    "$headrace" convert dam_break.mcap --format mp4 --out none
[ ! -e none ] || fail "a refused film left $(ls none)"
expect 2 'error usage \(--palette\): did you mean "cividis"\?' convert --format png --out none --palette cividi
expect 2 'error usage \(--view\): .*' convert --format png --out none --view below

expect 2 'error invalid_params \(--camera\): a part of the scene is behind the eye; .*' \
    convert --format png --out none --camera 0.5,0.4,0.2 --target 0,0,0
expect 2 'error invalid_params \(--up\): .*' convert --format png --out none --camera 0.5,5,0.2 --target 0.5,0,0.2
[ ! -e none ] || fail "a refused picture left $(ls none)"

skipped=
if command -v ffprobe >/dev/null 2>&1; then
    # An odd size is padded to an even one.
    convert --format mp4 --size 321x241 --fps 10 --palette magma --view iso --out film >run.txt 2>&1 || fail "$(cat run.txt)"
    film=$(ffprobe -v error -count_frames -select_streams v -of csv=p=0 \
        -show_entries stream=codec_name,width,height,avg_frame_rate,nb_read_frames film/dam_break.mp4)
    [ "$film" = "h264,322,242,10/1,6" ] || fail "the film is $film"
    [ "$(ls film)" = dam_break.mp4 ] || fail "beside the film there are $(ls film)"
else
    skipped+=' ffprobe'
fi

convert --format pov --from 0.045 --palette coolwarm --out pov >run.txt 2>&1 || fail "$(cat run.txt)"
[ "$(grep -c '^sphere{' pov/dam_break_000000.pov)" = 3000 ] || fail "not 3,000 spheres"
# Staubach 2010, Eq. 3.5, with the values of Table 3.1: cbrt(3 * 0.02 / (4 pi 998.29)) = 0.0168485 m.
grep -q '^#declare R = 0.0168485;' pov/dam_break_000000.pov || fail "radius: $(grep '#declare R' pov/*.pov)"
if command -v povray >/dev/null 2>&1; then
    povray pov/dam_break_000000.pov +W160 +H90 -D +Opov/picture.png >povray.txt 2>&1 || fail "povray: $(tail -5 povray.txt)"
    [ "$(head -c 4 pov/picture.png | tail -c 3)" = PNG ] || fail "povray made no picture"
else
    skipped+=' povray'
fi
[ -z "$skipped" ] || { echo "skipped: there is no$skipped" >&2; exit 77; }
