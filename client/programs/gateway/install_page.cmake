# cmake -D SOURCE=... -D WORK=... -D TARGET=... -D NPM=... -D NODE=... -D GZIP=...
#   -D STAMP=... -P install_page.cmake
# The page as browsers get it, in TARGET, and beside it the template of a page of one file: ours from SOURCE, and what it takes from npm, which is
# fetched into WORK. Where it cannot fetch there is no page, and a line says so; STAMP is made once
# there is one.
file(MAKE_DIRECTORY ${TARGET} ${WORK})
foreach(name package.json package-lock.json)
  file(COPY ${SOURCE}/${name} DESTINATION ${WORK})
endforeach()
file(SHA256 ${SOURCE}/package-lock.json wanted)
set(there "")
if(EXISTS ${WORK}/fetched)
  file(READ ${WORK}/fetched there)
endif()
if(NOT there STREQUAL wanted)
  execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
    WORKING_DIRECTORY ${WORK} RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE said)
  if(NOT failed EQUAL 0)
    message(WARNING "collision-gateway will have no page: npm ci has failed: ${said}")
    file(REMOVE ${STAMP})
    return()
  endif()
  file(WRITE ${WORK}/fetched ${wanted})
endif()
file(REMOVE_RECURSE ${TARGET})
file(COPY ${SOURCE}/ DESTINATION ${TARGET} PATTERN package*.json EXCLUDE)
set(modules ${WORK}/node_modules)
set(three build/three.module.js build/three.core.js LICENSE
  examples/jsm/controls/OrbitControls.js examples/jsm/geometries/ConvexGeometry.js
  examples/jsm/math/ConvexHull.js examples/jsm/renderers/CSS2DRenderer.js
  examples/jsm/utils/BufferGeometryUtils.js)
foreach(file ${three})
  get_filename_component(folder ${TARGET}/lib/three/${file} DIRECTORY)
  file(COPY ${modules}/three/${file} DESTINATION ${folder})
endforeach()
foreach(file uPlot.esm.js uPlot.min.css)
  file(COPY ${modules}/uplot/dist/${file} DESTINATION ${TARGET}/lib)
endforeach()
file(COPY_FILE ${modules}/uplot/LICENSE ${TARGET}/lib/uPlot.LICENSE)
# What reads MCAP files.
file(GLOB mcap ${modules}/@mcap/core/dist/esm/*.js)
list(FILTER mcap EXCLUDE REGEX "test")
file(COPY ${mcap} ${modules}/@mcap/core/LICENSE DESTINATION ${TARGET}/lib/mcap)
file(COPY ${modules}/@foxglove/crc/dist/esm/src/index.js ${modules}/@foxglove/crc/LICENSE.md
  DESTINATION ${TARGET}/lib/crc)
file(COPY ${modules}/heap-js/dist/heap-js.es5.js DESTINATION ${TARGET}/lib)
file(COPY_FILE ${modules}/heap-js/LICENSE ${TARGET}/lib/heap-js.LICENSE)
file(COPY_FILE ${modules}/fzstd/esm/index.mjs ${TARGET}/lib/fzstd.mjs)
file(COPY_FILE ${modules}/fzstd/LICENSE ${TARGET}/lib/fzstd.LICENSE)
if(NODE)
  execute_process(COMMAND ${NODE} ${SOURCE}/../single_page.mjs ${TARGET} ${TARGET}/../single.html
    COMMAND_ERROR_IS_FATAL ANY)
endif()
if(GZIP)
  file(GLOB_RECURSE texts ${TARGET}/*.js ${TARGET}/*.mjs ${TARGET}/*.css)
  execute_process(COMMAND ${GZIP} -9nkf ${texts} COMMAND_ERROR_IS_FATAL ANY)
endif()
file(TOUCH ${STAMP})
