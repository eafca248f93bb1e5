# The Python package, tested with pytest against the programs of this build. Where pytest, pyzmq or NumPy is missing, and
# where a file's tests are all skipped, ctest reports "skipped".
file(GLOB python_tests RELATIVE ${CMAKE_CURRENT_LIST_DIR} CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/test_*.py)
foreach(file IN LISTS python_tests)
  string(REGEX REPLACE "test_(.*)\\.py" "\\1" name ${file})
  add_test(NAME "python: ${name}"
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/support/needs.sh ${HEADRACE_PYTHON} pytest,zmq,numpy
                   -m pytest -q -rs -p no:cacheprovider ${CMAKE_CURRENT_LIST_DIR}/${file}
           WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties("python: ${name}" PROPERTIES LABELS python SKIP_RETURN_CODE 77 TIMEOUT 600 ENVIRONMENT
    "HEADRACE_SERVER_BINARY=$<TARGET_FILE:headraced>;HEADRACE_CLIENT_BINARY=$<TARGET_FILE:headrace>;PYTHONDONTWRITEBYTECODE=1;OMP_WAIT_POLICY=passive")
endforeach()
