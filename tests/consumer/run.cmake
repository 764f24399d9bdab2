# SPDX-License-Identifier: GPL-2.0-or-later
# cmake -DBUILD=build tree -DSOURCE=this folder -DWORK=scratch folder -P run.cmake
# Installs the project, builds the consumer against it, runs its programs.
function(step)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "failed with ${failed}: ${ARGN}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
step(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${WORK}/prefix
     -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=${CXX_FLAGS})
step(${CMAKE_COMMAND} --build ${WORK}/build)
step(${WORK}/build/rigid)
step(${WORK}/build/elastic)
step(${WORK}/build/particles)
step(${WORK}/build/plugged ${WORK}/build/liboscillator.so)

# Rigid walls link no structural code.
foreach(program rigid particles)
  execute_process(COMMAND nm -C ${WORK}/build/${program} OUTPUT_VARIABLE symbols RESULT_VARIABLE failed)
  if(failed OR NOT symbols MATCHES "coupling::RigidSurface" OR symbols MATCHES "structure::|io::ModelFile")
    message(FATAL_ERROR "${program} must hold the rigid surface and nothing of structure:: or io::")
  endif()
endforeach()
