# Tests that are scripts: the programs from outside, other projects' readers, and the order of the house.
# A script that lacks a tool it judges with exits 77, which ctest reports as skipped.
set(HEADRACE_PYTHON /usr/bin/python3 CACHE FILEPATH "Interpreter for script tests; has the Debian python3-* packages")

# headrace_script_test(NAME label script arguments... [NEEDS Python modules with commas] [FIXTURE name])
function(headrace_script_test name label script)
  cmake_parse_arguments(arg "" "NEEDS;FIXTURE" "" ${ARGN})
  set(script ${CMAKE_CURRENT_SOURCE_DIR}/${script})
  if(arg_NEEDS)
    set(command bash ${CMAKE_CURRENT_SOURCE_DIR}/support/needs.sh ${HEADRACE_PYTHON} ${arg_NEEDS} ${script})
  elseif(script MATCHES "\\.py$")
    set(command ${HEADRACE_PYTHON} ${script})
  else()
    set(command bash ${script})
  endif()
  add_test(NAME "${name}" COMMAND ${command} ${arg_UNPARSED_ARGUMENTS} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties("${name}" PROPERTIES LABELS ${label} SKIP_RETURN_CODE 77 TIMEOUT 600)
  if(arg_FIXTURE)
    set_tests_properties("${name}" PROPERTIES FIXTURES_REQUIRED ${arg_FIXTURE})
  endif()
endfunction()

set(root ${PROJECT_SOURCE_DIR})
set(results ${PROJECT_BINARY_DIR}/test_results)
file(MAKE_DIRECTORY ${results})

# The order of the house.
headrace_script_test("house: includes follow the layers" script support/check_layers.py ${root})
headrace_script_test("house: sources are in order" script support/check_sources.py ${root})
headrace_script_test("house: each header compiles alone" script support/check_headers.sh ${CMAKE_CXX_COMPILER} ${root})
headrace_script_test("house: sources are formatted" script support/check_format.sh ${root})
headrace_script_test("house: only missing packages are installed" script support/check_install.sh ${root})

# The protocol's documents, judged by others' tools.
headrace_script_test("schemas: examples and presets are valid" script support/check_schemas.py NEEDS jsonschema)
headrace_script_test("protocol: the reference is up to date" script support/protocol_reference.py
                     $<TARGET_FILE:headraced> $<TARGET_FILE:headrace> ${root})
headrace_script_test("protocol: what describe says holds" script support/check_description.py $<TARGET_FILE:headraced> ${root}
                     NEEDS zmq,jsonschema)

headrace_script_test("protocol: describe is OpenRPC by its makers' meta-schema" script support/check_openrpc.py
                     $<TARGET_FILE:headraced> NEEDS zmq,jsonschema)

# Recordings and frames, read by others. Frame 7 of the sample recording also comes as a file of its own.
add_executable(write_sample_recording support/write_sample_recording.cpp)
target_link_libraries(write_sample_recording PRIVATE headrace_recording)
foreach(compression none zstd)
  add_test(NAME "mcap: samples are written, ${compression}"
           COMMAND write_sample_recording ${results}/${compression}.mcap ${compression} ${results}/frame_${compression}.bin)
  set_tests_properties("mcap: samples are written, ${compression}" PROPERTIES LABELS script FIXTURES_SETUP samples)
endforeach()
headrace_script_test("mcap: the reference implementation reads our recordings" script support/check_mcap.sh ${root} 20
                     ${results}/none.mcap ${results}/zstd.mcap FIXTURE samples)
headrace_script_test("frame: ten lines of NumPy read it" script support/check_parse_frame.py ${results}/frame_none.bin
                     NEEDS numpy FIXTURE samples)

# What the plan leaves out costs nothing, by instruction counts: of a build without sanitizers, which valgrind cannot run,
# and with the optimiser, or it takes hours.
if(HEADRACE_BENCH AND NOT HEADRACE_SANITIZE AND CMAKE_BUILD_TYPE STREQUAL "Release")
  headrace_script_test("plan: what a scene does not have costs it no instruction" script bench/plan_costs.py
                       $<TARGET_FILE:headrace_bench> --check)
  headrace_script_test("plan: what nobody asks for costs the server no instruction" script bench/plan_costs.py
                       $<TARGET_FILE:headrace_bench> --server $<TARGET_FILE:headraced> $<TARGET_FILE:headrace>)
  set_tests_properties("plan: what a scene does not have costs it no instruction" PROPERTIES TIMEOUT 1800)
endif()

# The client as a user drives it. `commands` leaves recordings and converted files in ${results}/commands.
file(GLOB cli_scripts RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS cli/*.sh)
foreach(script IN LISTS cli_scripts)
  get_filename_component(name ${script} NAME_WE)
  headrace_script_test("cli: ${name}" cli ${script} $<TARGET_FILE:headraced> $<TARGET_FILE:headrace> ${root}
                       ${results})
endforeach()
set_tests_properties("cli: commands" PROPERTIES FIXTURES_SETUP commands)
headrace_script_test("mcap: the reference implementation reads the programs' recordings" script support/check_mcap.sh
                     ${root} 11 ${results}/commands/idle.mcap ${results}/commands/there.mcap FIXTURE commands)
headrace_script_test("vtp: VTK finds the numbers of the CSV files" script support/check_vtp.py
                     ${results}/commands/whole/idle.pvd --frames 11 --points 2197
                     --csv ${results}/commands/whole/idle_frames.csv FIXTURE commands)
set_tests_properties("cli: convert" PROPERTIES FIXTURES_SETUP converted)
headrace_script_test("npz, ply, csv: NumPy finds the same numbers" script support/check_converted.py ${results}/convert flat
                     --frames 11 NEEDS numpy FIXTURE converted)
headrace_script_test("ply: VTK finds the numbers of the CSV files" script support/check_converted.py ${results}/convert flat
                     --frames 11 --vtk NEEDS numpy FIXTURE converted)
headrace_script_test("vtp: VTK finds the numbers of a flat scene" script support/check_vtp.py ${results}/convert/flat.pvd
                     --frames 11 --points 100 --csv ${results}/convert/flat_frames.csv FIXTURE converted)
headrace_script_test("install: the programs work from where they are installed" script support/check_installed.sh
                     ${CMAKE_COMMAND} ${PROJECT_BINARY_DIR} ${results}/prefix)

headrace_script_test("install: manual pages are right and whole" script support/check_man.sh $<TARGET_FILE:headrace>
                     $<TARGET_FILE:headraced>)
include(${CMAKE_CURRENT_SOURCE_DIR}/python/tests.cmake)

# The main job, with the programs of this build.
headrace_script_test("demo: dam break from load to pictures" demo support/check_demo.sh ${PROJECT_BINARY_DIR} ${root}
                     ${results}/demo)
set_tests_properties("demo: dam break from load to pictures" PROPERTIES FIXTURES_SETUP demo)
headrace_script_test("vtp: VTK reads the demo's files" demo support/check_vtp.py ${results}/demo/dam_break/dam_break.pvd
                     --frames 301 --points 3000 FIXTURE demo)
headrace_script_test("mcap: the reference implementation reads the demo's recording" demo support/check_mcap.sh
                     ${root} 301 ${results}/demo/dam_break.mcap FIXTURE demo)
