// SPDX-License-Identifier: Apache-2.0
// The Khronos glTF validator on files: node validate.js FOLDER_OF_GLTF_VALIDATOR FILE.glb ... Exits with 1 at an error or a warning.
const fs = require("fs");
const validator = require(require("path").resolve(process.argv[2]));

async function main() {
  let good = true;
  for (const file of process.argv.slice(3)) {
    const { issues } = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { uri: file });
    console.log(`validator: ${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
    for (const issue of issues.messages) if (issue.severity < 2) console.log(`  ${issue.pointer}: ${issue.message}`);
    good = good && issues.numErrors === 0 && issues.numWarnings === 0;
  }
  process.exit(good ? 0 : 1);
}
main().catch((error) => { console.log(String(error)); process.exit(1); });
