# Runs PROGRAM on RECORDING/images and compares what it prints with RECORDING/labels.csv, byte for byte.
execute_process(COMMAND ${PROGRAM} ${RECORDING}/images OUTPUT_FILE ${MADE} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${MADE} ${RECORDING}/labels.csv RESULT_VARIABLE differs)
if(differs)
  message(FATAL_ERROR "${MADE} differs from ${RECORDING}/labels.csv")
endif()
