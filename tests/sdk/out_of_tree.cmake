# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# cmake -DBUILD=... -DWORK=... -DCOMPILER=... -DLAUNCHER=... -DGENERATOR=... -DLIBDIR=...
#       -P out_of_tree.cmake
function(step what)
  message(STATUS "${what}")
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what}: exit status ${status}\n${out}\n${err}")
  endif()
  set(OUTPUT "${out}" PARENT_SCOPE)
endfunction()

function(expect_file file)
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "${file} is missing")
  endif()
endfunction()

function(expect_text text)
  string(FIND "${OUTPUT}" "${text}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "'${text}' is not in:\n${OUTPUT}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
set(prefix ${WORK}/prefix)
set(velum ${prefix}/bin/velum)
unset(ENV{VELUM_PLUGIN_PATH})
unset(ENV{LD_LIBRARY_PATH})

step("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
step("new plugin" ${velum} new filtering.thin_out --dir ${WORK})
set(source ${WORK}/thin_out)
if(LAUNCHER MATCHES "NOTFOUND$")
  set(LAUNCHER "")
endif()
step("configure" ${CMAKE_COMMAND} -S ${source} -B ${source}/build -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${COMPILER}
  -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
step("build" ${CMAKE_COMMAND} --build ${source}/build)
step("its test" ${CMAKE_CTEST_COMMAND} --test-dir ${source}/build --output-on-failure)
expect_text("100% tests passed")

set(ENV{VELUM_PLUGIN_PATH} ${source}/build/plugins)
step("list" ${velum} list filtering)
expect_text("filtering.thin_out")
step("describe" ${velum} describe filtering.thin_out)
expect_text("Keeps every n-th point of a cloud.")
step("run" ${velum} run ${source}/example.toml --out ${WORK}/out --no-cache)
expect_file(${WORK}/out/thin_out.ply)
expect_file(${WORK}/out/run.json)

# Installed beside Velum's own plugins it is found without being told where.
unset(ENV{VELUM_PLUGIN_PATH})
step("install the plugin" ${CMAKE_COMMAND} --install ${source}/build --prefix ${prefix})
expect_file(${prefix}/${LIBDIR}/velum/plugins/filtering/thin_out.so)
step("run as installed" ${velum} run ${source}/example.toml --out ${WORK}/out2 --no-cache)
expect_file(${WORK}/out2/thin_out.ply)
